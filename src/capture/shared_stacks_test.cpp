// shared_stacks_test.cpp
