// photographs.cpp
