// photo_reader_test.cpp
