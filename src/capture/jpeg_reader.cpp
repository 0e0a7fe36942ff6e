// jpeg_reader.cpp
