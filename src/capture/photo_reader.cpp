// photo_reader.cpp
