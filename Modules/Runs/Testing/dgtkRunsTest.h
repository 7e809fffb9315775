// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunsTest_h
#define dgtkRunsTest_h

#include "dgtkTestSupport.h"

#include <QApplication>
#include <QSettings>

#include <gtest/gtest.h>

#include <filesystem>

namespace dgtk::test
{

/// An application on no display, whose data and settings are in a folder of its own.
class RunsTest : public testing::Test
{
protected:
  void SetUp() override
  {
    static const TemporaryFolder folder;
    qputenv("QT_QPA_PLATFORM", "offscreen");
    qputenv("XDG_DATA_HOME", QByteArray::fromStdString(folder.path("data")));
    qputenv("XDG_CONFIG_HOME", QByteArray::fromStdString(folder.path("config")));
    if (QCoreApplication::instance() == nullptr)
    {
      static int count = 1;
      static char name[] = "TestRuns";
      static char* arguments[] = { name, nullptr };
      static QApplication application(count, arguments);
      QCoreApplication::setOrganizationName("dgtk-test");
    }
    QSettings().clear();
    std::filesystem::remove_all(folder.path("data"));
  }
};

} // namespace dgtk::test

#endif
