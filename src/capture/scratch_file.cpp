// scratch_file.cpp
