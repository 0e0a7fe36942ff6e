#include "encode/encode_tile.h"

#include <gtest/gtest.h>
