// The structures shared with the kernels, as C++.
#pragma once

#include "cl/layout.h"
