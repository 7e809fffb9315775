// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLdiFile_h
#define dgtkLdiFile_h

#include "dgtkFile.h"
#include "dgtkLdi.h"

namespace dgtk
{

/// What the formats of layered depth images share: the file and the checks on the rows.
class LdiFileWriter : public LdiWriter
{
public:
  LdiFileWriter(const FilePlace& path, int width, int height);
  void write(const LdiRows& rows) final;
  FileRecord finish() final;

protected:
  virtual void writeRows(const LdiRows& rows) = 0;
  /// Everything is written; returns bytes and hash of the temporary file.
  virtual FileRecord complete() = 0;

  const std::string Path;
  const int Width;
  const int Height;
  AtomicFile File;

private:
  int NextRow = 0;
  bool Finished = false;
};

std::unique_ptr<LdiWriter> makeDeepExrWriter(const FilePlace& path, int width, int height);

} // namespace dgtk

#endif
