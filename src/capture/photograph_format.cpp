// photograph_format.cpp
