#include <gtest/gtest.h>

#include "illum/object.h"
