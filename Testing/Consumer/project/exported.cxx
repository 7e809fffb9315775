// SPDX-License-Identifier: BSD-3-Clause
// Renders a dataset and writes it in the format of centres.cxx: exported SCENE FOLDER.
#include <dgtkExport.h>
#include <dgtkFile.h>
#include <dgtkGenerator.h>

#include <cstdio>
#include <filesystem>

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    return 2;
  }
  std::filesystem::remove_all(argv[2]);
  try
  {
    dgtk::GeneratorRequest request;
    request.scene = argv[1];
    request.folder = std::string(argv[2]) + "/dataset";
    request.width = 32;
    request.height = 24;
    dgtk::addNeeds({ "centres" }, request.layers, request.options);
    dgtk::generate(request, {});
    dgtk::ExportRequest wanted;
    wanted.dataset = request.folder;
    wanted.folder = std::string(argv[2]) + "/centres";
    wanted.format = "centres";
    dgtk::exportDataset(wanted);
    const std::string table = dgtk::readFile(wanted.folder + "/centres.csv");
    std::fputs(table.c_str(), stdout);
    const std::string head = "camera,frame,x,y,z\n";
    return table.rfind(head, 0) == 0 && table.size() > head.size() ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
