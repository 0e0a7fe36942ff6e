// exif_orientation.cpp
