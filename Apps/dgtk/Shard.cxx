// SPDX-License-Identifier: BSD-3-Clause
#include "Shard.h"

#include "dgtkError.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

namespace dgtk::app
{

namespace
{
constexpr std::size_t mostShards = 1000000;

std::optional<std::size_t> wholeNumber(const std::string& text)
{
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos)
  {
    return std::nullopt;
  }
  return std::stoul(text);
}

std::optional<std::size_t> variable(const char* name)
{
  const char* const value = std::getenv(name);
  if (value == nullptr || *value == 0)
  {
    return std::nullopt;
  }
  const std::optional<std::size_t> number = wholeNumber(value);
  if (!number)
  {
    throw UsageError(std::string("--shard auto: ") + name + " is not a number: " + quoted(value));
  }
  return number;
}

RunShard checked(std::size_t index, std::size_t count, const std::string& from)
{
  if (count < 1 || count > mostShards || index >= count)
  {
    throw UsageError("--shard: expected I/N with I from 0 below N, found " + std::to_string(index) + '/' +
                     std::to_string(count) + from);
  }
  return { index, count };
}

/// An array may begin anywhere and go on in steps: its tasks are counted from its first one.
std::optional<RunShard> ofArray()
{
  const std::optional<std::size_t> task = variable("SLURM_ARRAY_TASK_ID");
  if (!task)
  {
    return std::nullopt;
  }
  const std::size_t first = variable("SLURM_ARRAY_TASK_MIN").value_or(0);
  const std::size_t last = variable("SLURM_ARRAY_TASK_MAX").value_or(*task);
  const std::size_t step = std::max<std::size_t>(variable("SLURM_ARRAY_TASK_STEP").value_or(1), 1);
  const std::size_t count = variable("SLURM_ARRAY_TASK_COUNT").value_or((last - first) / step + 1);
  if (*task < first || (*task - first) % step != 0 || count != (last - first) / step + 1)
  {
    throw UsageError(
      "--shard auto: the array job has only some of its tasks; number them one after another, or say I/N");
  }
  return checked((*task - first) / step, count, " (SLURM_ARRAY_TASK_ID)");
}
} // namespace

RunShard parseShard(const std::string& text)
{
  if (text != "auto")
  {
    const std::size_t slash = text.find('/');
    const std::optional<std::size_t> index = wholeNumber(text.substr(0, slash));
    const std::optional<std::size_t> count =
      slash == std::string::npos ? std::nullopt : wholeNumber(text.substr(slash + 1));
    if (!index || !count)
    {
      throw UsageError("--shard: expected I/N or auto, found " + quoted(text));
    }
    return checked(*index, *count, "");
  }
  if (const std::optional<RunShard> array = ofArray())
  {
    return *array;
  }
  // mpirun within a job of Slurm: all of its processes inherit one SLURM_PROCID
  for (const auto& [rank, size] : { std::pair{ "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE" },
         std::pair{ "PMI_RANK", "PMI_SIZE" }, std::pair{ "SLURM_PROCID", "SLURM_NTASKS" } })
  {
    const std::optional<std::size_t> index = variable(rank);
    const std::optional<std::size_t> count = variable(size);
    if (index && count)
    {
      return checked(*index, *count, std::string(" (") + rank + ')');
    }
  }
  throw UsageError("--shard auto: no launcher says which process this is (Slurm, Open MPI, PMI); say I/N instead");
}

} // namespace dgtk::app
