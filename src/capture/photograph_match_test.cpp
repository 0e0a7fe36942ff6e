// photograph_match_test.cpp
