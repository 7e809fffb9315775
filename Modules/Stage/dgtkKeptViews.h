// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkKeptViews_h
#define dgtkKeptViews_h

#include "dgtkCameraModel.h"
#include "dgtkSceneDescription.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace dgtk
{

/// The views of all cameras at the latest moments: pairs ask for those of all others, for each camera. Thread-safe.
class KeptViews
{
public:
  using Moment = std::tuple<double, int, int>; ///< frame, width, height

  /// That of a camera; made by `make()` where it isn't known. One with a table of rays, which is large, is not kept.
  template <typename Make>
  View at(const std::vector<CameraDescription>& cameras, std::size_t camera, const Moment& moment, const Make& make)
  {
    const auto& parameters = cameras[camera].parameters;
    if (std::any_of(parameters.begin(), parameters.end(), [](const auto& one) { return !one.second.file.empty(); }))
    {
      return make();
    }
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      const auto known = this->find(moment);
      if (known != this->Latest.end() && known->second[camera])
      {
        return *known->second[camera];
      }
    }
    View view = make();
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->find(moment) == this->Latest.end())
    {
      this->Latest.emplace_back(moment, cameras.size());
    }
    this->find(moment)->second[camera] = view;
    if (this->Latest.size() > most)
    {
      this->Latest.pop_front();
    }
    return view;
  }

private:
  using Views = std::pair<Moment, std::vector<std::optional<View>>>;
  static constexpr std::size_t most = 4;

  std::deque<Views>::iterator find(const Moment& moment)
  {
    return std::find_if(
      this->Latest.begin(), this->Latest.end(), [&](const Views& one) { return one.first == moment; });
  }

  std::mutex Mutex;
  std::deque<Views> Latest;
};

} // namespace dgtk

#endif
