// orientation.cpp
