// The structures shared with the kernels, as C++.
#pragma once

#include "layout.h"
