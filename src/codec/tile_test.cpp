#include "codec/tile.h"

#include <gtest/gtest.h>
