#include "object/manifest.h"

#include <gtest/gtest.h>
