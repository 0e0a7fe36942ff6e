// photographs_bench.cpp
