// oiio_reader.cpp
