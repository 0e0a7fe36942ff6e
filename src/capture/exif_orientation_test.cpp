// exif_orientation_test.cpp
