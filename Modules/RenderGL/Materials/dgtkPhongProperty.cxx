// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPhongProperty.h"

#include <vtkProperty.h>

namespace dgtk
{

void setProperty(const Material& material, vtkProperty& property)
{
  Eigen::Vector3d color = material.ambient;
  property.SetAmbient(1);
  property.SetAmbientColor(color.data());
  color = material.diffuse;
  property.SetDiffuse(1);
  property.SetDiffuseColor(color.data());
  color = material.specular;
  property.SetSpecular(1);
  property.SetSpecularColor(color.data());
  property.SetSpecularPower(material.shininess);
  property.SetOpacity(material.opacity);
}

} // namespace dgtk
