#include "object/index_file.h"

#include <gtest/gtest.h>
