// file_pool.cpp
