// sample_rows.cpp
