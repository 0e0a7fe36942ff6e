// band_plan.cpp
