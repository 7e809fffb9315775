// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkKeptSource.h"

#include "dgtkRenderGLCalls.h"
#include "dgtkSystem.h"

#include <algorithm>
#include <tuple>

#include <unistd.h>

namespace dgtk
{

namespace
{
bool usesGL(const FrameSourceOptions& options)
{
  const LayerNeeds& needs = options.needs;
  return (options.drawn && (needs.color || needs.peeled || !needs.mattes.empty())) || (needs.hits && options.raster);
}

bool same(const FrameSourceOptions& a, const FrameSourceOptions& b)
{
  const auto all = [](const FrameSourceOptions& options)
  {
    const LayerNeeds& needs = options.needs;
    return std::tie(needs.hits, needs.color, needs.sharp, needs.peeled, needs.mattes, options.raster, options.drawn,
      options.samples, options.filter, options.gl);
  };
  return all(a) == all(b);
}
} // namespace

void KeptSource::use(const FrameSourceOptions& options, const std::shared_ptr<const Stage>& stage, const Draw& draw)
{
  this->leaveInherited();
  if (!this->Pool)
  {
    this->Pool = std::make_unique<ThreadPool>(machineThreads());
  }
  if (!same(options, this->Options))
  {
    this->drop();
  }
  std::shared_ptr<GLTurn> turn;
  if (usesGL(options))
  {
    turn = renderGL().takeTurn();
  }
  if (!this->Source)
  {
    this->Options = options;
    this->Source = std::make_unique<FrameSource>(options, *this->Pool);
  }
  if (this->Scene != stage)
  {
    this->Queries = std::make_unique<TracedQueries>(stage);
    this->Scene = stage;
  }
  draw(*this->Source, *this->Queries, *this->Pool);
}

void KeptSource::drop()
{
  this->leaveInherited();
  std::shared_ptr<GLTurn> turn;
  if (this->Source && usesGL(this->Options))
  {
    turn = renderGL().takeTurn();
  }
  this->Source.reset();
}

/// The threads of what a process finds when it was forked are not there: its end would wait for them.
void KeptSource::leaveInherited()
{
  if (this->Process != ::getpid())
  {
    static_cast<void>(this->Source.release());
    static_cast<void>(this->Queries.release());
    static_cast<void>(this->Pool.release());
    this->Scene = nullptr;
    this->Process = ::getpid();
  }
}

} // namespace dgtk
