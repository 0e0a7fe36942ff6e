// scratch_file_test.cpp
