// sample_rows_test.cpp
