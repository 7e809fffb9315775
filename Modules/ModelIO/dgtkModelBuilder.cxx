// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelBuilder.h"
