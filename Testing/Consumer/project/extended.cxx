// SPDX-License-Identifier: BSD-3-Clause
// A program with a layer and a file format of its own, a file and a row each: renders them into a dataset and into
// arrays, and compares.
#include <dgtkDatasetDocuments.h>
#include <dgtkGenerator.h>
#include <dgtkRenderer.h>
#include <dgtkScene.h>

#include <vtkDataArray.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace
{
void require(bool right, const char* what)
{
  if (!right)
  {
    std::fprintf(stderr, "%s\n", what);
    std::exit(1);
  }
}
} // namespace

int main(int, char** argv)
{
  const auto infos = dgtk::generatorLayers();
  const auto info = std::find_if(infos.begin(), infos.end(), [](const auto& one) { return one.layer == "curvature"; });
  require(
    info != infos.end() && info->options.size() == 2, "the layer is in the list, with its option and its formats");
  dgtk::GeneratorRequest request;
  request.scene = argv[1];
  request.folder = argv[2];
  request.layers = { "curvature" };
  request.width = 32;
  request.height = 24;
  request.replace = true;
  request.options = { { "curvature_reach", "2" }, { "curvature_format", "npy,text" } };
  require(dgtk::generate(request).files > 0, "it is rendered");
  const dgtk::Manifest manifest = dgtk::readManifest(request.folder + "/manifest.json");
  const auto asked = std::find(
    manifest.request.begin(), manifest.request.end(), std::pair<std::string, std::string>("curvature_reach", "2"));
  require(
    asked != manifest.request.end() && manifest.layers.size() == 2, "the manifest has the option and both formats");

  vtkNew<dgtkScene> scene;
  require(scene->Load(request.scene), "the scene is loaded");
  vtkNew<dgtkRenderer> renderer;
  renderer->SetScene(scene);
  renderer->SetSize(32, 24);
  renderer->SetOption("curvature_reach", "2");
  vtkDataArray* const values = renderer->Render("curvature");
  require(values != nullptr && values->GetNumberOfTuples() == 32 * 24, "it comes as an array");
  std::ifstream file(request.folder + "/front/curvature/000000.txt");
  int bends = 0;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    std::string word;
    require(bool(file >> word), "the file has a number for each pixel");
    const double stored = std::strtod(word.c_str(), nullptr);
    const double value = values->GetComponent(i, 0);
    require(std::isnan(value) ? std::isnan(stored) : value == stored, "file and array have the same values");
    bends += value > 0 ? 1 : 0;
  }
  require(bends > 3, "a pyramid has edges");
  return 0;
}
