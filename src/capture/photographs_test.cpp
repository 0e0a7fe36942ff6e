// photographs_test.cpp
