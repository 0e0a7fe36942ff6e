// file_pool_test.cpp
