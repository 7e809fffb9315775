// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSnapshot.h"

#include "dgtkArrayMemory.h"
#include "dgtkError.h"
#include "dgtkFrozenPair.h"
#include "dgtkFrozenView.h"
#include "dgtkInterpreterPause.h"
#include "dgtkSavedSnapshot.h"
#include "dgtkTracedView.h"

#include "vtkActor.h"
#include "vtkDoubleArray.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <new>

vtkStandardNewMacro(dgtkSnapshot);

namespace
{
/// The system has memory that is zero: of that, what nobody writes into takes no time.
vtkSmartPointer<vtkUnsignedIntArray> zeros(std::int64_t count)
{
  auto made = vtkSmartPointer<vtkUnsignedIntArray>::New();
  auto* const values =
    static_cast<unsigned int*>(std::calloc(std::size_t(std::max<std::int64_t>(count, 1)), sizeof(unsigned int)));
  if (values == nullptr)
  {
    throw std::bad_alloc();
  }
  made->SetArray(values, vtkIdType(count), 0, vtkUnsignedIntArray::VTK_DATA_ARRAY_FREE);
  return made;
}

std::string asLines(const std::vector<std::string>& all)
{
  std::string lines;
  for (const std::string& line : all)
  {
    lines += line + '\n';
  }
  return lines;
}

void requireMemory(dgtkSnapshot& of, std::size_t bytesOfPixel)
{
  dgtk::requireArrayMemory(
    of.GetWidth(), of.GetHeight(), double(of.GetWidth()) * of.GetHeight() * double(bytesOfPixel));
}
} // namespace

struct dgtkSnapshot::Internal
{
  dgtk::FrozenView view;
  dgtk::View camera;
  vtkSmartPointer<vtkDataArray> cells;
  std::vector<vtkSmartPointer<vtkUnsignedIntArray>> counts; // one a prop
  vtkSmartPointer<vtkDoubleArray> positions;
  vtkSmartPointer<vtkUnsignedCharArray> classes;
  std::vector<std::string> changes;
  const dgtk::FrozenView& taken() const
  {
    if (!this->view.stage)
    {
      throw dgtk::UsageError("no renderer was taken");
    }
    return this->view;
  }
};

dgtkSnapshot::dgtkSnapshot()
  : Self(new Internal)
{
}

dgtkSnapshot::~dgtkSnapshot() = default;

void dgtkSnapshot::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Size: " << this->GetWidth() << " x " << this->GetHeight() << "\n";
  os << indent << "SkipUnsupported: " << this->SkipUnsupported << "\n";
}

bool dgtkSnapshot::Take(vtkRenderer* renderer, int width, int height)
{
  *this->Self = Internal();
  this->SetStage(nullptr);
  return this->Attempt(
    [&]
    {
      if (renderer == nullptr)
      {
        throw dgtk::UsageError("there is no renderer");
      }
      if ((width != 0 || height != 0) && (width < 1 || height < 1))
      {
        throw dgtk::UsageError("size out of range (expected two numbers from 1)");
      }
      this->Self->view = dgtk::freeze(*renderer, width, height, this->SkipUnsupported);
      this->Self->camera = this->Self->view.stage->view(0, 0);
      this->SetStage(this->Self->view.stage);
    });
}

std::string dgtkSnapshot::GetLeftOut() const { return asLines(this->Self->view.left); }

int dgtkSnapshot::GetNumberOfProps() const { return static_cast<int>(this->Self->view.actors.size()); }

vtkProp* dgtkSnapshot::GetProp(int index) const
{
  return index >= 0 && index < this->GetNumberOfProps() ? this->Self->view.actors[std::size_t(index)].actor.Get()
                                                        : nullptr;
}

vtkIdType dgtkSnapshot::GetNumberOfCells(int index) const
{
  return this->GetProp(index) != nullptr ? vtkIdType(this->Self->view.actors[std::size_t(index)].inputCells) : 0;
}

int dgtkSnapshot::GetWidth() const { return this->Self->view.stage ? this->Self->camera.model->width() : 0; }

int dgtkSnapshot::GetHeight() const { return this->Self->view.stage ? this->Self->camera.model->height() : 0; }

void dgtkSnapshot::GetK(double K[9]) const
{
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Eigen::Map<Rows> to(K);
  to = this->Self->view.stage ? this->Self->camera.model->linear()->K : Eigen::Matrix3d(Eigen::Matrix3d::Zero());
}

void dgtkSnapshot::GetR(double R[9]) const
{
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Eigen::Map<Rows> to(R);
  to = this->Self->camera.camera_from_world.rotation;
}

void dgtkSnapshot::GetT(double t[3]) const
{
  Eigen::Map<Eigen::Vector3d> to(t);
  to = this->Self->camera.camera_from_world.translation;
}

vtkDataArray* dgtkSnapshot::TraceCells()
{
  Internal& self = *this->Self;
  const bool done = this->Attempt(
    [&]
    {
      const dgtk::FrozenView& view = self.taken();
      requireMemory(*this, sizeof(std::int64_t) + sizeof(dgtk::Hit));
      const auto cells = vtkSmartPointer<vtkTypeInt64Array>::New();
      cells->SetName("cells");
      cells->SetNumberOfValues(vtkIdType(this->GetWidth()) * this->GetHeight());
      {
        const dgtk::InterpreterPause pause;
        const std::vector<dgtk::Hit> hits = dgtk::traceView(*view.stage, self.camera);
        std::transform(hits.begin(), hits.end(), cells->GetPointer(0),
          [&view](const dgtk::Hit& hit) { return dgtk::cellOf(view, hit); });
      }
      self.cells = cells;
    });
  return done ? self.cells.Get() : nullptr;
}

bool dgtkSnapshot::CountCells()
{
  Internal& self = *this->Self;
  self.counts.clear();
  return this->Attempt(
    [&]
    {
      const dgtk::FrozenView& view = self.taken();
      if (std::uint64_t(this->GetWidth()) * std::uint64_t(this->GetHeight()) >
          std::numeric_limits<std::uint32_t>::max())
      {
        throw dgtk::UsageError("image size out of range: it has more pixels than a cell's count may be");
      }
      std::vector<std::uint32_t*> pixels;
      std::vector<vtkSmartPointer<vtkUnsignedIntArray>> counts;
      for (const dgtk::FrozenActor& actor : view.actors)
      {
        counts.push_back(zeros(actor.inputCells));
        pixels.push_back(counts.back()->GetPointer(0));
      }
      {
        const dgtk::InterpreterPause pause;
        dgtk::traceTiles(*view.stage, self.camera,
          [&](const dgtk::VisibilityBuffer& tile)
          {
            for (const dgtk::Hit& hit : tile.hits)
            {
              if (hit.object != 0)
              {
                ++pixels[view.actorOf(hit)][dgtk::cellOf(view, hit)];
              }
            }
          });
      }
      self.counts.swap(counts);
    });
}

vtkDataArray* dgtkSnapshot::CountPixels(int index)
{
  Internal& self = *this->Self;
  const bool done = this->Attempt(
    [&]
    {
      if (index < 0 || std::size_t(index) >= self.counts.size())
      {
        throw dgtk::UsageError("there is no such prop, or its cells were not counted");
      }
    });
  return done ? self.counts[std::size_t(index)].Get() : nullptr;
}

bool dgtkSnapshot::Correspond(dgtkSnapshot* other)
{
  Internal& self = *this->Self;
  self.positions = nullptr;
  self.classes = nullptr;
  return this->Attempt(
    [&]
    {
      if (other == nullptr)
      {
        throw dgtk::UsageError("there is no other snapshot");
      }
      const dgtk::FrozenView& from = self.taken();
      const dgtk::FrozenView& to = other->Self->taken();
      requireMemory(*this, 2 * sizeof(double) + 1 + sizeof(dgtk::Hit));
      const vtkIdType pixels = vtkIdType(this->GetWidth()) * this->GetHeight();
      const auto positions = vtkSmartPointer<vtkDoubleArray>::New();
      positions->SetNumberOfComponents(2);
      positions->SetNumberOfTuples(pixels);
      const auto classes = vtkSmartPointer<vtkUnsignedCharArray>::New();
      classes->SetNumberOfTuples(pixels);
      {
        const dgtk::InterpreterPause pause;
        dgtk::correspondViews(from, to, positions->GetPointer(0), classes->GetPointer(0));
      }
      self.positions = positions;
      self.classes = classes;
    });
}

vtkDataArray* dgtkSnapshot::GetPositions() const { return this->Self->positions; }

vtkDataArray* dgtkSnapshot::GetClasses() const { return this->Self->classes; }

bool dgtkSnapshot::Save(const std::string& path)
{
  this->Self->changes.clear();
  return this->Attempt([&] { this->Self->changes = dgtk::saveSnapshot(this->Self->taken(), path); });
}

std::string dgtkSnapshot::GetChanges() const { return asLines(this->Self->changes); }
