// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAppCommands_h
#define dgtkAppCommands_h

#include "Options.h"

namespace dgtk::app
{

// One file a command; each returns the process's exit status or throws an Error.
Command renderCommand();
Command mergeCommand();
Command sampleCommand();
Command infoCommand();
Command convertCommand();
Command correspondCommand();
Command exportCommand();
Command compareCommand();
Command verifyCommand();
Command reportCommand();
Command warpCommand();
Command listCommand();

struct CommandRow
{
  const char* name;
  Command (*make)(); ///< what a command's options can be may cost the loading of libraries
  const char* help;  ///< one line
};
/// All of them, in the order of the help.
const std::vector<CommandRow>& commandRows();
Command commandOf(const CommandRow& row);

/// Text on standard output; MachineError when it cannot be written (a full disk behind a redirection).
void print(const std::string& text);

/// Of the formats that datasets can be exported to.
std::vector<std::string> exporterNames();

/// Gets the process ready for OpenGL before anything uses it; may start the program anew (OSMesa needs a preload).
void prepareGL(const std::string& backend, int threads);

} // namespace dgtk::app

#endif
