// orientation_test.cpp
