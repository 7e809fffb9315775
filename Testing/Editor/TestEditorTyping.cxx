// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorTyping.h"
#include "TestEditorSupport.h"

#include "dgtkCameraEntry.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QCheckBox>
#include <QDialog>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QSpinBox>
#include <QStatusBar>
#include <QTest>
#include <QToolBar>
#include <QTreeWidget>

#include <cmath>
#include <functional>
#include <vector>

using dgtk::SceneItem;

namespace
{
void typeIntoField(QDialog& dialog, const char* name, const QString& text)
{
  auto* field = dialog.findChild<QLineEdit*>(name);
  field->setFocus();
  field->selectAll();
  QTest::keyClicks(field, text);
}

/// A lens of a program of its own: r = f * angle, and a list that does nothing.
class Lens final : public dgtk::CameraModel
{
public:
  explicit Lens(const dgtk::CameraParameters& of)
    : CameraModel(of)
    , Focal(of.height / 2.0 / of.number("halfAngle"))
  {
  }
  std::string name() const override { return "lens"; }
  dgtk::CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const double x = (pixel.x() - this->width() / 2.0) / this->Focal;
    const double y = (pixel.y() - this->height() / 2.0) / this->Focal;
    const double angle = std::hypot(x, y);
    const double across = angle > 0 ? std::sin(angle) / angle : 1;
    return { { 0, 0, 0 }, { across * x, across * y, std::cos(angle) } };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    const double across = std::hypot(x.x(), x.y());
    const double scale = across > 0 ? this->Focal * std::atan2(across, x.z()) / across : 0;
    pixel = { this->width() / 2.0 + scale * x.x(), this->height() / 2.0 + scale * x.y() };
    return across > 0 || x.z() > 0;
  }

private:
  double Focal;
};

std::shared_ptr<const dgtk::CameraModel> makeLens(const dgtk::CameraParameters& of)
{
  return std::make_shared<Lens>(of);
}

const dgtk::CameraEntry lens = {
  { { "halfAngle", "radians", "of the image's height", { 0, 3, true, true, "a number above 0, below 3" }, { 1 }, { 1 },
      true },
    { "list", "", "does nothing", { -1, 1, false, false, "a number from -1 to 1" }, { 0, 0.5, 0, 0 }, { 4, 5 } } },
  &makeLens
};
const bool lensAdded = dgtk::addCamera({ "lens", "for a test", &lens });

void add(const QDialog& dialog) { QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton); }
} // namespace

void TestEditorTyping::whatIsBeingTypedIsSaved()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const dgtk::SceneDocument& document = this->Window->document();
  this->select("tree");
  const auto saved = [&]
  {
    dgtk::SceneDocument again;
    again.open(document.path());
    return again.scene().objects[2];
  };
  this->typeOnly("position.0", "12.5");
  QTest::keyClick(this->field("position.0"), Qt::Key_S, Qt::ControlModifier);
  QCOMPARE(saved().position.value.x(), 12.5);
  this->typeOnly("position.0", "13.5");
  auto* tools = this->Window->findChild<QToolBar*>("toolBar");
  QTest::mouseClick(tools->widgetForAction(this->action("save")), Qt::LeftButton);
  QCOMPARE(saved().position.value.x(), 13.5);
  this->typeOnly("class", "oak");
  QTest::keyClick(this->field("class"), Qt::Key_S, Qt::ControlModifier);
  QCOMPARE(saved().className, std::string("oak"));
  this->typeOnly("position.0", "14.5");
  answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Save)->click(); });
  QVERIFY(this->Window->close());
  QCOMPARE(saved().position.value.x(), 14.5);
}

void TestEditorTyping::whatIsBeingTypedIsKept()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  this->select("tree");
  this->typeOnly("position.0", "12.5");
  document.editItem("another change", { SceneItem::Kind::Object, 2 },
    [](dgtk::SceneDescription& scene) { scene.objects[2].position.value.y() = 2; });
  QCOMPARE(this->field("position.0")->text(), QString("12.5"));
  QCOMPARE(this->field("position.1")->text(), QString("2"));
  QTest::keyClick(this->field("position.0"), Qt::Key_Return);
  QCOMPARE(document.scene().objects[2].position.value, Eigen::Vector3d(12.5, 2, -3.4));
  this->typeOnly("class", "oak");
  document.undo();
  QCOMPARE(this->field("class")->text(), QString("oak"));
  QCOMPARE(this->field("position.0")->text(), QString("4.2"));
  this->action("undo")->trigger();
  QVERIFY(document.scene().objects[2].className != "oak");
  QVERIFY(this->field("class")->text() != "oak");
}

void TestEditorTyping::quaternionsAreTypedAsOne()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  const auto rotation = [&] { return document.scene().objects[2].orientation.value; };
  this->select("tree");
  const dgtk::Quaternion before = rotation();
  this->typeOnly("orientation.0", "0.7071");
  this->typeOnly("orientation.1", "0.7071");
  this->typeOnly("orientation.2", "0");
  this->typeOnly("orientation.3", "0");
  QVERIFY(rotation() == before);
  this->field("position.0")->setFocus();
  QVERIFY(std::abs(rotation().norm() - 1) < 1e-15);
  QVERIFY(std::abs(rotation().x - std::sqrt(0.5)) < 1e-15);
  QVERIFY(std::abs(this->field("rotation.0")->text().toDouble() - 90) < 1e-9);
  this->typeOnly("orientation.0", "0.6");
  this->type("orientation.1", "0.8");
  QCOMPARE(rotation().w, 0.6);
  QCOMPARE(rotation().x, 0.8);
  QString message;
  expectRefusal(message);
  this->typeOnly("orientation.0", "0");
  this->type("orientation.1", "0");
  QVERIFY2(message.contains("tree"), qPrintable(message));
  QCOMPARE(this->field("orientation.1")->text(), QString("0.8"));
}

void TestEditorTyping::aRefusalComesOnce()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->select("tree");
  int boxes = 0;
  QTimer closer;
  connect(&closer, &QTimer::timeout, &closer,
    [&]
    {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
      {
        ++boxes;
        QCOMPARE(this->field("name")->text(), QString("tree"));
        box->accept();
      }
    });
  closer.start(50);
  this->type("name", "house");
  QTest::qWait(settle);
  QCOMPARE(boxes, 1);
  QCOMPARE(this->field("name")->text(), QString("tree"));
}

void TestEditorTyping::dialogsKeepWhatIsRefused()
{
  const dgtk::SceneDocument& document = this->Window->document();
  QString message;
  const auto refuseThenAdd = [&](const char* dialogName, const char* field, const QString& bad, const QString& good)
  {
    answer<QDialog>(dialogName,
      [&, dialogName, field, bad, good](QDialog& dialog)
      {
        typeIntoField(dialog, "name", "Top");
        typeIntoField(dialog, field, bad);
        expectRefusal(message);
        add(dialog);
        QVERIFY2(!message.isEmpty(), dialogName);
        QVERIFY(dialog.isVisible());
        QCOMPARE(dialog.findChild<QLineEdit*>("name")->text(), QString("Top"));
        typeIntoField(dialog, field, good);
        add(dialog);
        QVERIFY(!dialog.isVisible());
      });
  };
  refuseThenAdd("cameraDialog", "eye.2", "1e400", "3");
  this->action("camera")->trigger();
  QVERIFY2(message.contains("1e400"), qPrintable(message));
  QCOMPARE(document.scene().cameras.at(0).eye.value.z(), 3.0);
  this->action("undo")->trigger();
  refuseThenAdd("cameraDialog", "fovY.0", "190", "50");
  this->action("camera")->trigger();
  QCOMPARE(document.scene().cameras.at(0).name, std::string("Top"));
  QCOMPARE(document.scene().cameras.at(0).fovY.value, 50.0);
  refuseThenAdd("lightDialog", "diffuse.0", "-1", "0.5");
  this->action("light")->trigger();
  QCOMPARE(document.scene().lights.at(0).name, std::string("Top"));
  answer<QDialog>("cameraArrayDialog",
    [](QDialog& dialog)
    {
      typeIntoField(dialog, "fovY.0", "190");
      add(dialog);
      QVERIFY(dialog.findChild<QLabel*>("fault")->isVisible());
      typeIntoField(dialog, "fovY.0", "50");
      add(dialog);
      QVERIFY(!dialog.isVisible());
    });
  this->action("cameraArray")->trigger();
  QCOMPARE(document.scene().cameras.size(), std::size_t(9));
}

void TestEditorTyping::hugeSizesAreRefused()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  this->select(document.scene().cameras.front().name.c_str());
  for (const char* size : { "4294967936", "1e300", "-1e300" }) // the first is 640 to an int that wraps
  {
    QString message;
    expectRefusal(message);
    this->type("size.0", size);
    QVERIFY2(!message.isEmpty(), size);
    QCOMPARE(document.json(), first);
  }
}

/// In the window the old value comes back, and the status bar says why.
void TestEditorTyping::numbersThatAreNoneAreTold()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  this->select("tree");
  for (const char* text : { "1e999", " ", "12 m" })
  {
    this->Window->statusBar()->clearMessage();
    this->type("position.2", text);
    QVERIFY2(this->Window->statusBar()->currentMessage().startsWith(QString("\"%1\"").arg(text)),
      qPrintable(this->Window->statusBar()->currentMessage()));
    QCOMPARE(this->field("position.2")->text(), QString("-3.4"));
  }
  for (const auto& [name, text] : { std::pair("frame", "-5"), std::pair("frame", "99999999999"),
         std::pair("frameRate", "-5"), std::pair("frameRate", "fast") })
  {
    auto* const box = this->Window->findChild<QAbstractSpinBox*>(name);
    const QString before = box->text();
    this->Window->statusBar()->clearMessage();
    typeInto(box, text);
    QVERIFY2(this->Window->statusBar()->currentMessage().startsWith(QString("\"%1\"").arg(text)),
      qPrintable(QString(name) + text + this->Window->statusBar()->currentMessage()));
    QCOMPARE(box->text(), before);
  }
  QCOMPARE(document.json(), first);
}

/// Other rows come with other units; the field that was left last stays the one that is typed in.
void TestEditorTyping::unitsAreTyped()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(dgtk::test::sourceFile("Data/Models/crate.ac"))));
  this->Window->document().edit("none", [](dgtk::SceneDescription&) {});
  QTest::mouseClick(this->Window->findChild<QWidget*>("view.0"), Qt::LeftButton, {}, QPoint(3, 3));
  const dgtk::SceneDescription& scene = this->Window->document().scene();
  for (const char* units : { "metre", "cm", "m" })
  {
    QTest::mouseClick(this->field("units"), Qt::LeftButton);
    QTRY_VERIFY(this->field("units")->hasFocus());
    this->field("units")->selectAll();
    QTest::keyClicks(this->field("units"), units);
    QTest::keyClick(this->field("units"), Qt::Key_Return);
    untilQuiet(); // what went is deleted
    QCOMPARE(scene.units, std::string(units));
    QCOMPARE(this->field("units")->text(), QString(units));
    QVERIFY(this->field("units")->hasFocus());
  }
  this->select("crate-1");
  bool labelled = false;
  for (const QLabel* label : this->Window->findChild<QWidget*>("propertiesPanel")->findChildren<QLabel*>())
  {
    labelled = labelled || label->text() == "Position, m";
  }
  QVERIFY(labelled);
}

/// A model of a program of its own has its rows; what is typed is written, and taken back.
void TestEditorTyping::parametersOfAModelAreTyped()
{
  QVERIFY(lensAdded && this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  document.edit("a lens",
    [](dgtk::SceneDescription& scene)
    {
      scene.cameras[0].model = "lens";
      scene.cameras[0].fovY = dgtk::CameraDescription().fovY; // which that model does not have
    });
  const std::string before = document.json();
  this->select(document.scene().cameras[0].name.c_str());
  QCOMPARE(this->field("halfAngle.0")->text(), QString("1"));
  QCOMPARE(this->field("list.1")->text(), QString("0.5"));
  this->type("halfAngle.0", "1.25");
  this->type("list.3", "-0.25");
  const auto& values = document.scene().cameras[0].parameters;
  QCOMPARE(values.at("halfAngle").numbers.at(0).at(0), 1.25);
  QCOMPARE(values.at("list").numbers.size(), std::size_t(4));
  QVERIFY(document.json().find("\"list\": [0, 0.5, 0, -0.25]") != std::string::npos);
  QString message;
  expectRefusal(message);
  this->type("halfAngle.0", "3");
  QVERIFY2(message.contains("above 0, below 3"), qPrintable(message));
  document.undo();
  document.undo();
  QCOMPARE(document.json(), before);
}

/// What a layer needs is asked in the window, and what no camera has is not offered.
void TestEditorTyping::everyNumberIsOfItsOwnProperty()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  struct Row
  {
    const char* item;
    const char* field;
    double typed;
    std::function<double(const dgtk::SceneDescription&)> value;
  };
  const Row table[] = { { "right", "near.0", 0.5, [](const auto& s) { return s.cameras[1].near; } },
    { "right", "far.0", 300, [](const auto& s) { return s.cameras[1].far; } },
    { "right", "fovY.0", 50, [](const auto& s) { return s.cameras[1].fovY.value; } },
    { "right", "aspect.0", 1.5, [](const auto& s) { return s.cameras[1].aspect; } },
    { "right", "eye.0", 0.25, [](const auto& s) { return s.cameras[1].eye.value.x(); } },
    { "right", "eye.1", 2, [](const auto& s) { return s.cameras[1].eye.value.y(); } },
    { "right", "lookAt.1", 1.5, [](const auto& s) { return s.cameras[1].lookAt.value.y(); } },
    { "right", "lookAt.2", -1, [](const auto& s) { return s.cameras[1].lookAt.value.z(); } },
    { "right", "up.0", 0.125, [](const auto& s) { return s.cameras[1].up.value.x(); } },
    { "tree", "position.2", -4, [](const auto& s) { return s.objects[2].position.value.z(); } },
    { "tree", "scale.1", 1.25, [](const auto& s) { return s.objects[2].scale.value.y(); } },
    { "spot", "position.0", -1, [](const auto& s) { return s.lights[2].position.value.x(); } },
    { "spot", "target.1", 0.5, [](const auto& s) { return s.lights[2].target.value.y(); } },
    { "spot", "intensity.0", 2, [](const auto& s) { return s.lights[2].intensity.value; } },
    { "spot", "coneAngle.0", 20, [](const auto& s) { return s.lights[2].coneAngle.value; } },
    { "spot", "exponent.0", 16, [](const auto& s) { return s.lights[2].exponent.value; } } };
  for (const Row& row : table)
  {
    this->select(row.item);
    std::vector<double> before;
    std::vector<double> after;
    const auto values = [&]
    {
      std::vector<double> all;
      for (const Row& other : table)
      {
        all.push_back(other.value(document.scene()));
      }
      return all;
    };
    before = values();
    this->type(row.field, QString::number(row.typed));
    after = values();
    for (std::size_t i = 0; i < after.size(); ++i)
    {
      const double expected = &table[i] == &row ? row.typed : before[i];
      QVERIFY2(after[i] == expected, qPrintable(QString("%1, then %2").arg(row.field, table[i].field)));
    }
  }
}

void TestEditorTyping::allLayersAreRendered()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->select("tree");
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  QVERIFY(!dialog->findChild<QCheckBox*>("layer.color_sharp")->isEnabled());
  dialog->findChild<QPushButton*>("allLayers")->click();
  QCOMPARE(dialog->findChild<QLineEdit*>("matte")->text(), QString("tree"));
  dialog->findChild<QCheckBox*>("ownSize")->setChecked(false);
  dialog->findChild<QSpinBox*>("width")->setValue(48);
  dialog->findChild<QSpinBox*>("height")->setValue(36);
  dialog->findChild<QLineEdit*>("folder")->setText(this->path("all"));
  auto* start = dialog->findChild<QPushButton*>("start");
  start->click();
  QTRY_VERIFY(start->isEnabled());
  QVERIFY2(QFile::exists(this->path("all/manifest.json")), qPrintable(dialog->findChild<QLabel*>("status")->text()));
  const QStringList files = contents(this->path("all")).keys();
  QVERIFY2(!files.filter("matting").isEmpty(), qPrintable(files.join(' ').left(2000)));
  this->Window->document().editItem("shutter", { dgtk::SceneItem::Kind::Camera, 0 },
    [](dgtk::SceneDescription& scene) { scene.cameras[0].shutter.close = 0.5; });
  QVERIFY(dialog->findChild<QCheckBox*>("layer.color_sharp")->isEnabled());
}

/// A row goes while its field has the focus and something is typed there.
void TestEditorTyping::rowsEndQuietly()
{
  bool gone = false;
  answer<QDialog>("cameraDialog",
    [&gone](QDialog& dialog)
    {
      auto* field = dialog.findChild<QLineEdit*>("eye.0");
      QTest::mouseClick(field, Qt::LeftButton);
      QTRY_VERIFY(field->hasFocus());
      QTest::keyClicks(field, "5");
      delete field->parentWidget();
      gone = dialog.findChild<QLineEdit*>("eye.0") == nullptr;
      dialog.reject();
    });
  this->action("camera")->trigger();
  QVERIFY(gone);
  QVERIFY(this->Window->document().scene().cameras.empty());
}

DGTK_EDITOR_TEST(TestEditorTyping);
