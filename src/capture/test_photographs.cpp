// test_photographs.cpp
