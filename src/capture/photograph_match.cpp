// photograph_match.cpp
