// light_file_search_test.cpp
