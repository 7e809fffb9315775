// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfacePieces.h"

#include <vtkActor.h>
#include <vtkAlgorithmOutput.h>
#include <vtkCellData.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkCompositeDataSet.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeRange.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkIdTypeArray.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyDataMapper.h>
#include <vtkScalarsToColors.h>

#include <limits>
#include <numeric>
#include <set>

namespace dgtk
{

namespace
{
/// VTK's mapping of scalars to colours with the settings of a mapper, which keeps its own results.
class ScalarMapper : public vtkMapper
{
public:
  static ScalarMapper* New();
  vtkTypeMacro(ScalarMapper, vtkMapper);
  void Render(vtkRenderer*, vtkActor*) override {}
  double* GetBounds() override { return this->Bounds; }
  using vtkMapper::GetBounds;

protected:
  ScalarMapper() = default;
};
vtkStandardNewMacro(ScalarMapper);

vtkSmartPointer<vtkPolyData> surfaceOf(vtkDataSet& data, vtkSmartPointer<vtkDataArray>& cells)
{
  if (vtkPolyData* const poly = vtkPolyData::SafeDownCast(&data))
  {
    return poly;
  }
  // The filter's own numbers are wrong for cells of higher order (VTK 9.1), but not which cell's values it copies.
  constexpr const char* name = "dgtkCells";
  vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName(name);
  numbers->SetNumberOfValues(data.GetNumberOfCells());
  std::iota(numbers->GetPointer(0), numbers->GetPointer(data.GetNumberOfCells()), vtkIdType(0));
  const auto numbered = vtkSmartPointer<vtkDataSet>::Take(data.NewInstance());
  numbered->ShallowCopy(&data);
  numbered->GetCellData()->AddArray(numbers);
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputDataObject(numbered);
  surface->Update();
  vtkSmartPointer<vtkPolyData> made = surface->GetOutput();
  cells = made->GetCellData()->GetArray(name);
  const vtkIdType count = made->GetNumberOfCells();
  if (count > 0 && (cells == nullptr || cells->GetNumberOfTuples() < count || cells->GetRange()[0] < 0 ||
                     cells->GetRange()[1] >= double(data.GetNumberOfCells())))
  {
    throw InputError("VTK scene", "has a surface whose cells VTK does not know");
  }
  return made;
}

/// One of some colours, so many times.
vtkSmartPointer<vtkUnsignedCharArray> oneColor(vtkUnsignedCharArray& colors, vtkIdType which, vtkIdType count)
{
  auto made = vtkSmartPointer<vtkUnsignedCharArray>::New();
  made->SetNumberOfComponents(colors.GetNumberOfComponents());
  made->SetNumberOfTuples(which < colors.GetNumberOfTuples() ? count : 0);
  for (vtkIdType i = 0; i < made->GetNumberOfTuples(); ++i)
  {
    made->SetTuple(i, which, &colors);
  }
  return made;
}

/// What the blocks of a composite data set inherit from those above.
struct BlockStyle
{
  bool visible = true;
  std::optional<Eigen::Vector3d> color;
  std::optional<double> opacity;
};

class PieceMaker
{
public:
  PieceMaker(const ViewActor& actor, Unsupported& unsupported)
    : Actor(actor)
    , Mapper(*actor.actor->GetMapper())
    , Out(unsupported)
  {
  }

  void addAll(vtkDataObject* data)
  {
    auto* const composite = vtkCompositePolyDataMapper2::SafeDownCast(&this->Mapper);
    this->Attributes = composite != nullptr ? composite->GetCompositeDataDisplayAttributes() : nullptr;
    this->add(data, {});
  }

  /// Of all leaves.
  vtkIdType cells() const { return this->FirstCell; }

  std::vector<SurfacePiece> Pieces;

private:
  void add(vtkDataObject* data, BlockStyle style)
  {
    this->inherit(data, style);
    if (auto* const tree = vtkDataObjectTree::SafeDownCast(data))
    {
      using Options = vtk::DataObjectTreeOptions;
      for (const auto& child : vtk::Range(tree, Options::None))
      {
        this->add(child, style);
      }
      return;
    }
    if (vtkDataSet* const leaf = vtkDataSet::SafeDownCast(data))
    {
      this->addLeaf(*leaf, style);
      this->FirstCell += leaf->GetNumberOfCells();
    }
    else if (data != nullptr)
    {
      this->Out.add(this->Actor.name + ": " + classOf(*data));
    }
  }

  void inherit(vtkDataObject* data, BlockStyle& style) const
  {
    if (this->Attributes == nullptr || data == nullptr)
    {
      return;
    }
    vtkCompositeDataDisplayAttributes& a = *this->Attributes;
    style.visible = a.HasBlockVisibility(data) ? a.GetBlockVisibility(data) : style.visible;
    if (a.HasBlockOpacity(data))
    {
      style.opacity = a.GetBlockOpacity(data);
    }
    if (a.HasBlockColor(data))
    {
      const vtkColor3d color = a.GetBlockColor(data);
      style.color = Eigen::Vector3d(color[0], color[1], color[2]);
    }
  }

  void addLeaf(vtkDataSet& leaf, const BlockStyle& style)
  {
    if (!style.visible || leaf.GetNumberOfCells() == 0)
    {
      return;
    }
    SurfacePiece piece;
    piece.data = surfaceOf(leaf, piece.cells);
    if (piece.data == nullptr)
    {
      return;
    }
    piece.firstCell = this->FirstCell;
    piece.blockColor = style.color;
    piece.blockOpacity = style.opacity;
    if (piece.data->GetNumberOfVerts() > 0)
    {
      this->Out.add(this->Actor.name + ": points of its data");
    }
    if (piece.data->GetNumberOfLines() > 0)
    {
      this->Out.add(this->Actor.name + ": lines of its data");
    }
    if (piece.data->GetNumberOfPolys() + piece.data->GetNumberOfStrips() == 0)
    {
      return;
    }
    if (!style.color)
    {
      mapColors(this->Mapper, *piece.data, piece);
      this->mapMissing(piece);
    }
    this->Pieces.push_back(std::move(piece));
  }

  /// A block without the scalars that are mapped, where the mapper gives it the colour of what is no number.
  void mapMissing(SurfacePiece& piece) const
  {
    auto* const composite = vtkCompositePolyDataMapper2::SafeDownCast(&this->Mapper);
    if (composite != nullptr && composite->GetColorMissingArraysWithNanColor() &&
        composite->GetScalarVisibility() != 0 && piece.colors == nullptr && piece.colorMapAt == nullptr)
    {
      piece.blockColor.emplace();
      composite->GetLookupTable()->GetColor(std::numeric_limits<double>::quiet_NaN(), piece.blockColor->data());
    }
  }

  const ViewActor& Actor;
  vtkMapper& Mapper;
  Unsupported& Out;
  vtkCompositeDataDisplayAttributes* Attributes = nullptr;
  vtkIdType FirstCell = 0;
};

bool drawsSurfaces(vtkMapper& mapper)
{
  const std::string name = classOf(mapper);
  return name == "vtkPolyDataMapper" || name == "vtkDataSetMapper" || name == "vtkCompositePolyDataMapper" ||
         name == "vtkCompositePolyDataMapper2" || name == "vtkHierarchicalPolyDataMapper";
}
} // namespace

void mapColors(vtkMapper& mapper, vtkDataSet& data, SurfacePiece& piece, double opacity)
{
  if (mapper.GetScalarVisibility() == 0)
  {
    return;
  }
  vtkNew<ScalarMapper> colors;
  colors->ShallowCopy(&mapper);
  int ofCells = 0;
  vtkUnsignedCharArray* const found = colors->MapScalars(&data, opacity, ofCells);
  if (found != nullptr)
  {
    piece.colors = found;
    piece.colorsOfCells = ofCells != 0;
    if (mapper.GetScalarMode() == VTK_SCALAR_MODE_USE_FIELD_DATA && mapper.GetFieldDataTupleId() >= 0)
    {
      piece.colors = oneColor(*found, mapper.GetFieldDataTupleId(), data.GetNumberOfCells());
    }
  }
  else if (colors->GetColorCoordinates() != nullptr)
  {
    piece.colorMapAt = colors->GetColorCoordinates();
    piece.colorMap = colors->GetColorTextureMap();
  }
}

namespace
{
/// Whether a step gave nothing; VTK keeps error codes though a step works again.
bool gaveNothing(vtkAlgorithm& step)
{
  vtkDataObject* const data = step.GetNumberOfOutputPorts() > 0 ? step.GetOutputDataObject(0) : nullptr;
  if (vtkCompositeDataSet* const blocks = vtkCompositeDataSet::SafeDownCast(data))
  {
    return blocks->GetNumberOfPoints() == 0;
  }
  vtkDataSet* const set = vtkDataSet::SafeDownCast(data);
  return data == nullptr || (set != nullptr && set->GetNumberOfPoints() == 0);
}

/// Which step of the pipeline that ends here has an error code and gave nothing; null for none. Not all readers leave
/// one.
vtkAlgorithm* failedStep(vtkAlgorithm& step, std::set<vtkAlgorithm*>& seen)
{
  if (step.GetErrorCode() != vtkErrorCode::NoError && gaveNothing(step))
  {
    return &step;
  }
  for (int port = 0; port < step.GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < step.GetNumberOfInputConnections(port); ++i)
    {
      vtkAlgorithm* const input = step.GetInputAlgorithm(port, i);
      vtkAlgorithm* const failed = input != nullptr && seen.insert(input).second ? failedStep(*input, seen) : nullptr;
      if (failed != nullptr)
      {
        return failed;
      }
    }
  }
  return nullptr;
}

/// Why a mapper's pipeline gives no data, "" when it does. It says so once only, and its data are empty then as if they
/// were meant to be.
std::string pipelineFailure(vtkMapper& mapper)
{
  bool updated = true;
  for (int port = 0; port < mapper.GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < mapper.GetNumberOfInputConnections(port); ++i)
    {
      vtkAlgorithmOutput& output = *mapper.GetInputConnection(port, i);
      updated = output.GetProducer()->GetExecutive()->Update(output.GetIndex()) != 0 && updated;
    }
  }
  std::set<vtkAlgorithm*> seen;
  vtkAlgorithm* const failed = failedStep(mapper, seen);
  if (failed != nullptr)
  {
    return classOf(*failed) + " failed (" + vtkErrorCode::GetStringFromErrorCode(failed->GetErrorCode()) + ')';
  }
  return updated ? std::string() : "its pipeline failed";
}
} // namespace

DrawnSurface surfacePieces(const ViewActor& actor, Unsupported& unsupported)
{
  vtkMapper& mapper = *actor.actor->GetMapper();
  if (mapper.GetNumberOfInputConnections(0) == 0)
  {
    return {};
  }
  if (mapper.GetStatic() == 0)
  {
    const std::string failure = pipelineFailure(mapper);
    if (!failure.empty())
    {
      unsupported.add(actor.name + ": " + failure);
      return {};
    }
    vtkPolyDataMapper* const inParts = vtkPolyDataMapper::SafeDownCast(&mapper);
    if (inParts != nullptr && inParts->GetNumberOfSubPieces() > 1) // of which an update leaves the last one
    {
      mapper.GetInputAlgorithm()->UpdatePiece(
        inParts->GetPiece(), inParts->GetNumberOfPieces(), inParts->GetGhostLevel());
    }
    else
    {
      mapper.Update();
    }
  }
  if (mapper.IsA("vtkGlyph3DMapper") != 0)
  {
    return glyphPieces(actor, mapper, unsupported);
  }
  if (!drawsSurfaces(mapper))
  {
    unsupported.add(actor.name + ": " + classOf(mapper));
    return {};
  }
  PieceMaker maker(actor, unsupported);
  maker.addAll(mapper.GetInputDataObject(0, 0));
  return { std::move(maker.Pieces), maker.cells() };
}

} // namespace dgtk
