// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCloudView_h
#define dgtkCloudView_h

#include "dgtkDatasetPoints.h"
#include "dgtkLineActor.h"
#include "dgtkViewWidget.h"

#include <vtkSmartPointer.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkActor;
class vtkPolyData;

namespace dgtk
{

/// The cameras and points of a dataset in the world. Mouse as in the editor's perspective view: left turns, middle or
/// Shift and left pans, right and wheel zoom; a click on a camera chooses it.
class CloudView : public ViewWidget
{
  Q_OBJECT

public:
  explicit CloudView(QWidget* parent);
  ~CloudView() override;

  /// Forgets everything; the world's up axis is that of the next dataset.
  void reset(UpAxis upAxis);
  /// Frusta of these views; the one called `chosen` is marked.
  void setCameras(const std::vector<View>& views, const std::string& chosen);
  void setCloud(const std::shared_ptr<const PointCloud>& cloud);
  /// A cross at a point of the world.
  void setMarker(const std::optional<Eigen::Vector3d>& point);
  /// Shows everything but the outermost points.
  void frameAll();
  /// The same from behind and above a camera.
  void frameFrom(const std::string& name);
  /// To the place of a camera, looking its way.
  void lookThrough(const std::string& name);
  std::size_t pointCount() const { return this->Cloud ? this->Cloud->points.size() : 0; }

signals:
  void cameraPicked(const QString& name);

protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void draw() override;

private:
  void refreshLines();
  WorldBox box() const;
  static WorldBox middleOf(const std::vector<Eigen::Vector3d>& points);
  void pick(const QPoint& at);

  vtkSmartPointer<vtkPolyData> Points;
  vtkSmartPointer<vtkActor> PointActor;
  std::unique_ptr<LineActor> Frusta;
  std::unique_ptr<LineActor> Chosen;
  std::unique_ptr<LineActor> Marker;
  std::unique_ptr<LineActor> Axes[3];
  std::vector<CameraPlace> Places;
  std::string ChosenName;
  std::shared_ptr<const PointCloud> Cloud;
  WorldBox CloudBox;
  std::optional<Eigen::Vector3d> MarkerPoint;
};

} // namespace dgtk

#endif
