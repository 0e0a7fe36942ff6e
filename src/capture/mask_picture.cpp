// mask_picture.cpp
