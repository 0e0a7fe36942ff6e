#include "object/entry_name.h"

#include <gtest/gtest.h>
