// The structures shared with the kernels, as C++.
#pragma once

#include "cl/layout.h"
#include "cl/stream_layout.h"
