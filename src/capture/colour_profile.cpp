// colour_profile.cpp
