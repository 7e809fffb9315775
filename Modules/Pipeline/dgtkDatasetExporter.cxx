// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetExporter.h"

#include "dgtkBackgroundRun.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExporterEntry.h"
#include "dgtkFolderWay.h"

#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(dgtkDatasetExporter);

struct dgtkDatasetExporter::Internal
{
  dgtk::ExportRequest request;
  dgtkBackgroundRun background;
};

namespace
{
void run(const dgtk::ExportRequest& request, const std::atomic<bool>& cancel,
  const std::function<void(dgtkBackgroundRun::Report)>& report)
{
  dgtk::ExportCallbacks callbacks;
  callbacks.cancel = &cancel;
  callbacks.progress = [&](const dgtk::ExportProgress& one) { report({ one.done, one.total }); };
  dgtk::withWayOut(
    [&]
    {
      if (dgtk::exportDataset(request, callbacks).interrupted)
      {
        throw dgtk::MachineError(request.folder + ": interrupted; resume completes it");
      }
    });
}
} // namespace

dgtkDatasetExporter::dgtkDatasetExporter()
  : Self(new Internal)
{
}

dgtkDatasetExporter::~dgtkDatasetExporter() = default;

void dgtkDatasetExporter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dataset: " << this->Self->request.dataset << "\n";
  os << indent << "Folder: " << this->Self->request.folder << "\n";
  os << indent << "Format: " << this->Self->request.format << "\n";
}

void dgtkDatasetExporter::SetDataset(const std::string& folder)
{
  this->Self->request.dataset = folder;
  this->Modified();
}

void dgtkDatasetExporter::SetFolder(const std::string& folder)
{
  this->Self->request.folder = folder;
  this->Modified();
}

void dgtkDatasetExporter::SetFormat(const std::string& name)
{
  this->Self->request.format = name;
  this->Modified();
}

void dgtkDatasetExporter::SetFrames(int first, int last, int step)
{
  dgtk::DatasetSelection& selection = this->Self->request.selection;
  selection.someFrames = true;
  selection.first = first;
  selection.last = last;
  selection.step = std::max(step, 1);
  this->Modified();
}

void dgtkDatasetExporter::SetOption(const std::string& name, const std::string& value)
{
  this->Self->request.options[name] = value;
  this->Modified();
}

std::string dgtkDatasetExporter::GetOptions()
{
  std::string lines;
  for (const dgtk::OptionRow* row : dgtk::allExportOptions())
  {
    lines += row->name + '\t' + row->value + '\t' + row->fallback + '\t' + row->help + '\n';
  }
  return lines;
}

std::string dgtkDatasetExporter::GetFormats()
{
  std::string lines;
  for (const dgtk::ExporterRow& row : dgtk::exporterRows())
  {
    lines +=
      row.info.name + '\t' + dgtk::joinedNames(row.make()->needs({}).layers) + '\t' + row.info.description + '\n';
  }
  return lines;
}

void dgtkDatasetExporter::SetResume(bool resume)
{
  this->Self->request.resume = resume;
  this->Modified();
}

void dgtkDatasetExporter::SetReplace(bool replace)
{
  this->Self->request.replace = replace;
  this->Modified();
}

void dgtkDatasetExporter::Start()
{
  this->Self->background.start(
    [request = this->Self->request](const auto& cancel, const auto& report) { run(request, cancel, report); });
}

bool dgtkDatasetExporter::IsRunning() const { return this->Self->background.isRunning(); }

bool dgtkDatasetExporter::Wait(int milliseconds) { return this->Self->background.wait(milliseconds); }

int dgtkDatasetExporter::GetDone() const { return static_cast<int>(this->Self->background.last().done); }

int dgtkDatasetExporter::GetTotal() const { return static_cast<int>(this->Self->background.last().total); }

void dgtkDatasetExporter::Cancel() { this->Self->background.cancel(); }

std::string dgtkDatasetExporter::GetErrorMessage() const { return this->Self->background.failure().message; }

int dgtkDatasetExporter::GetErrorCode() const { return this->Self->background.failure().code; }
