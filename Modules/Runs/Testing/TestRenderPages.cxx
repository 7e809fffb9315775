// SPDX-License-Identifier: BSD-3-Clause
// The render configuration, on no display.
#include "dgtkRenderCameras.h"
#include "dgtkRenderDialog.h"

#include "dgtkEditorState.h"
#include "dgtkFile.h"
#include "dgtkRunsTest.h"

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>

#include <gtest/gtest.h>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
class RenderPages : public RunsTest
{
protected:
  void open(EditorState& state, const std::string& scene) const
  {
    writeFile(this->Folder.path("quad.obj"), "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n");
    writeFile(this->Folder.path("scene.json"), scene);
    state.document().open(this->Folder.path("scene.json"));
  }

  TemporaryFolder Folder;
};
} // namespace

TEST_F(RenderPages, MattesOfTheSelectionAreNamesWithCommas)
{
  EditorState state(nullptr);
  this->open(state, R"({"objects": [{"name": "a,b", "model": "quad.obj"}, {"name": "c", "model": "quad.obj"}]})");
  const RenderDialog dialog(state, nullptr);
  state.select({ { SceneItem::Kind::Object, 0 }, { SceneItem::Kind::Object, 1 } });
  EXPECT_EQ(dialog.findChild<QLineEdit*>("matte")->text(), "a\\,b,c");
}

// What is shown is rendered, not what another program has written into its file.
TEST_F(RenderPages, TheSceneIsRenderedAsItIsShown)
{
  const QByteArray program = qgetenv("DGTK");
  qputenv("DGTK", "/bin/true");
  const auto sceneWith = [](const char* eye)
  { return R"({"cameras": [{"name": "a", "eye": [)" + std::string(eye) + R"(], "lookAt": [0, 0, 0]}]})"; };
  EditorState state(nullptr);
  this->open(state, sceneWith("0, 0, 5"));
  const auto rendered = [&](const char* folder)
  {
    RenderDialog dialog(state, nullptr);
    QString scene;
    int starts = 0;
    QObject::connect(&dialog, &RenderDialog::noted, [&](const QString& line) { scene = line.section(' ', 2, 2); });
    QObject::connect(&dialog, &RenderDialog::started, [&] { ++starts; });
    dialog.findChild<QLineEdit*>("folder")->setText(QString::fromStdString(this->Folder.path(folder)));
    dialog.findChild<QPushButton*>("start")->click();
    EXPECT_EQ(starts, 1);
    return scene.toStdString();
  };
  const std::string own = this->Folder.path("scene.json");
  EXPECT_EQ(rendered("first"), own);
  writeFile(own, sceneWith("0, 3, 7"));
  const std::string copy = rendered("second");
  EXPECT_NE(copy, own);
  EXPECT_EQ(readScene(copy).cameras.front().eye.value, Eigen::Vector3d(0, 0, 5));
  state.document().open(own);
  EXPECT_EQ(rendered("third"), own);
  qputenv("DGTK", program);
}

// K of 40 x 30 pixels is scaled to the size of all images, as a run scales it.
TEST_F(RenderPages, ACameraOfAMatrixTakesTheCommonSize)
{
  EditorState state(nullptr);
  this->open(state, R"({"cameras": [{"name": "k", "width": 40, "height": 30, "K": [[50, 0, 20], [0, 50, 15], [0, 0, 1]],
    "eye": [0, 0, 5], "lookAt": [0, 0, 0], "near": 1, "far": 100}]})");
  RenderCameras page(state, nullptr);
  const auto* said = page.findChild<QLabel*>("resolution");
  const auto has = [&said](const char* text) { return said->text().contains(text); };
  EXPECT_TRUE(has("40 x 30 pixels") && has(">0.1 units<") && has(">2 units<")) << said->text().toStdString();
  page.findChild<QCheckBox*>("ownSize")->setChecked(false);
  page.findChild<QSpinBox*>("width")->setValue(80);
  page.findChild<QSpinBox*>("height")->setValue(60);
  EXPECT_TRUE(has("80 x 60 pixels") && has(">0.05 units<") && has(">1 units<")) << said->text().toStdString();
}
