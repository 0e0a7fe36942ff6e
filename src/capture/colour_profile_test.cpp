// colour_profile_test.cpp
