// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEditorLanguage.h"
#include "dgtkError.h"
#include "dgtkMainWindow.h"
#include "dgtkModelCache.h"
#include "dgtkSystem.h"

#include <QApplication>
#include <QFileInfo>
#include <QIcon>
#include <QTimer>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include <signal.h>

namespace
{
constexpr const char* help =
  "usage: dgtk-editor [--language LANGUAGE] [FILE|FOLDER...]\n\n"
  "The desktop editor of DGTk. A scene (.json, .scene) is opened; models are imported into\n"
  "it; the folder of a finished dataset is shown in a window of its own.\n\n"
  "  --language LANGUAGE   language of the window: de, en (default: the system's)\n"
  "  --help                this page\n"
  "  --version             the version\n\n"
  "DGTK of the environment names the dgtk program that renders (default: beside this one).\n";

constexpr int wrongUsage = 2;

struct Words
{
  QString language;
  QStringList files;
  QString problem; ///< "" when all is well
};

/// The command line without what is Qt's.
Words parse(const QStringList& arguments)
{
  Words words;
  bool options = true;
  for (int i = 1; i < arguments.size(); ++i)
  {
    const QString& word = arguments[i];
    if (!options || !word.startsWith("--"))
    {
      words.files << word;
    }
    else if (word == "--")
    {
      options = false;
    }
    else if (word.startsWith("--language=") || (word == "--language" && i + 1 < arguments.size()))
    {
      words.language = word == "--language" ? arguments[++i] : word.section('=', 1);
    }
    else
    {
      words.problem = word == "--language" ? "--language needs a value" : "unknown option '" + word + "'";
    }
  }
  return words;
}

bool isDataset(const QString& file) { return QFileInfo(file).isDir() || QFileInfo(file).fileName() == "manifest.json"; }

int fail(const QString& what)
{
  std::fprintf(stderr, "dgtk-editor: %s (see dgtk-editor --help)\n", what.toLocal8Bit().constData());
  return wrongUsage;
}
} // namespace

int main(int argc, char** argv)
{
  ::signal(SIGXFSZ, SIG_IGN); // a file beyond the limit of `ulimit -f` is an error of writing
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
  dgtk::holdStandardStreams();
  dgtk::prepareHeap();
  dgtk::MainWindow::prepareApplication();
  QApplication application(argc, argv);
  dgtk::MainWindow::setupApplication();
  QApplication::setDesktopFileName("dgtk-editor"); // its row in the menu, by which desktops know its windows
  QApplication::setWindowIcon(QIcon::fromTheme("dgtk-editor"));
  const Words words = parse(QApplication::arguments());
  if (!words.problem.isEmpty())
  {
    return fail(words.problem);
  }
  if (!dgtk::setEditorLanguage(words.language))
  {
    return fail(
      "--language: expected one of " + dgtk::editorLanguages().join(", ") + ", found '" + words.language + "'");
  }
  try
  {
    dgtk::ModelCache::use(dgtk::ModelCache::ofUser());
  }
  catch (const dgtk::Error& error)
  {
    std::fprintf(stderr, "dgtk-editor: %s\n", error.what());
    return static_cast<int>(error.code());
  }
  dgtk::MainWindow window;
  window.show();
  QTimer::singleShot(0, &window,
    [&window, &words]
    {
      window.findRuns();
      window.offerRecovery();
      if (!words.files.isEmpty() &&
          std::all_of(words.files.begin(), words.files.end(), [](const QString& file) { return isDataset(file); }))
      {
        window.openForDatasets();
      }
      for (const QString& file : words.files)
      {
        window.openFile(file);
      }
    });
  return QApplication::exec();
}
