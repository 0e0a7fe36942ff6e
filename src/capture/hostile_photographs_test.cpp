// hostile_photographs_test.cpp
