// band_plan_test.cpp
