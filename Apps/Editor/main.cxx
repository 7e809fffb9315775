// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMainWindow.h"

#include <QApplication>
#include <QTimer>

#include <cstdio>
#include <cstring>

namespace
{
constexpr const char* help =
  "usage: dgtk-editor [FILE|FOLDER...]\n\n"
  "The desktop editor of DGTk. A scene (.json, .scene) is opened; models are imported into\n"
  "it; the folder of a finished dataset is shown in a window of its own.\n\n"
  "  --help      this page\n"
  "  --version   the version\n\n"
  "DGTK of the environment names the dgtk program that renders (default: beside this one).\n";
} // namespace

int main(int argc, char** argv)
{
  for (int i = 1; i < argc; ++i)
  {
    if (std::strcmp(argv[i], "--help") == 0 || std::strcmp(argv[i], "-h") == 0)
    {
      std::fputs(help, stdout);
      return 0;
    }
    if (std::strcmp(argv[i], "--version") == 0)
    {
      std::puts("dgtk-editor " DGTK_VERSION);
      return 0;
    }
  }
  dgtk::MainWindow::prepareApplication();
  QApplication application(argc, argv);
  dgtk::MainWindow::setupApplication();
  dgtk::MainWindow window;
  window.show();
  const QStringList files = QApplication::arguments().mid(1);
  QTimer::singleShot(0, &window,
    [&window, files]
    {
      window.offerRecovery();
      for (const QString& file : files)
      {
        window.openFile(file);
      }
    });
  return QApplication::exec();
}
