// light_file_search.cpp
