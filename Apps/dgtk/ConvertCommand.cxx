// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkSceneDescription.h"

namespace dgtk::app
{

namespace
{
int run(const Arguments& arguments)
{
  writeScene(readScene(arguments.positional()[0]), arguments.positional()[1]);
  return 0;
}
} // namespace

Command convertCommand()
{
  return { "convert", "IN OUT", 2, 2, "Converts a scene between .scene and .json.", {}, &run };
}

} // namespace dgtk::app
