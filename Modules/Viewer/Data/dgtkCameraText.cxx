// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraText.h"

#include "dgtkPixelText.h"

#include <QCoreApplication>
#include <QStringList>

#include <algorithm>
#include <exception>
#include <vector>

namespace dgtk
{

namespace
{
/// Words of this file, in the language of the window.
struct Words
{
  Q_DECLARE_TR_FUNCTIONS(CameraText)
};

/// Without the sign of a zero.
QString signless(double value)
{
  return QString::fromStdString(numberText(value == 0 ? 0.0 : value, PixelType::Float64));
}

/// Rows with their columns below each other.
QString rows(const QString& name, const Eigen::MatrixXd& matrix)
{
  std::vector<int> widths(std::size_t(matrix.cols()), 0);
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
  {
    int& width = widths[std::size_t(i / matrix.rows())]; // column by column
    width = std::max(width, int(signless(matrix.data()[i]).size()));
  }
  QString lines = name + '\n';
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
  {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
    {
      lines += "  " + signless(matrix(row, column)).rightJustified(widths[std::size_t(column)]);
    }
    lines += '\n';
  }
  return lines;
}

QString recordText(const CameraRecord& record)
{
  QString parameters;
  for (const auto& [name, numbers] : record.numbers)
  {
    QStringList list;
    for (const double number : numbers)
    {
      list << signless(number);
    }
    parameters += QString::fromStdString(name) + ": " + list.join(", ") + '\n';
  }
  return Words::tr("Size: %1 x %2 pixels").arg(record.width).arg(record.height) + '\n' +
         Words::tr("Lens: %1").arg(QString::fromStdString(record.model)) + '\n' +
         (parameters.isEmpty() ? Words::tr("Distortion: %1").arg(Words::tr("none")) + '\n' : parameters) +
         Words::tr("Near, far: %1, %2").arg(signless(record.near), signless(record.far)) + "\n\n" +
         (record.hasK ? rows(Words::tr("K (pixels from camera axes)"), record.K) + '\n' : QString()) +
         rows(Words::tr("R (x_camera = R x_world + t)"), record.R) + '\n' + rows("t", record.t);
}

QString fileText(const std::string& path)
{
  try
  {
    const Calibration calibration = readCalibration(path);
    return '\n' + Words::tr("Layer calibration (axes of OpenGL, y up)") + "\n\n" + rows("K", calibration.K) + '\n' +
           rows("R|t", calibration.Rt) + '\n' + Words::tr("Viewport") + "\n  " +
           QString("%1 %2 %3 %4").arg(calibration.x).arg(calibration.y).arg(calibration.width).arg(calibration.height) +
           '\n';
  }
  catch (const std::exception& error)
  {
    return '\n' + QString::fromStdString(error.what()) + '\n';
  }
}
} // namespace

QString cameraText(const DatasetPictures& dataset, const std::string& camera, int frame)
{
  QString lines = Words::tr("%1, frame %2").arg(QString::fromStdString(camera), QString::number(frame)) + '\n';
  const CameraRecord* const record = dataset.camera(camera, frame);
  lines += record ? recordText(*record) : Words::tr("cameras.json does not have this camera at this frame.") + '\n';
  const std::string path = dataset.document(DatasetDocument::Calibration, camera, frame);
  return path.empty() ? lines : lines + fileText(path);
}

} // namespace dgtk
