// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAppShard_h
#define dgtkAppShard_h

#include "dgtkRunShards.h"

#include <string>

namespace dgtk::app
{

/// "I/N", or "auto": as the launcher's environment says it, of Slurm's array jobs (SLURM_ARRAY_TASK_ID), Open MPI
/// (OMPI_COMM_WORLD_RANK), others with PMI (PMI_RANK) or srun (SLURM_PROCID), whichever is there first. Throws
/// UsageError.
RunShard parseShard(const std::string& text);

} // namespace dgtk::app

#endif
