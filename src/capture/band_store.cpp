// band_store.cpp
