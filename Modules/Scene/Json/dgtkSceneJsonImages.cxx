// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneJsonRows.h"

namespace dgtk::scenefile
{

namespace
{
using Environment = EnvironmentDescription;
using Fog = FogDescription;
using Shutter = ShutterDescription;
using Lens = LensDescription;
} // namespace

const std::vector<JsonField<Environment>>& environmentFields()
{
  static const std::vector<JsonField<Environment>> fields{
    row<&Environment::image>("image"),
    row<&Environment::intensity, rules::light>("intensity"),
    row<&Environment::rotation, rules::degrees>("rotation"),
    row<&Environment::background>("background"),
  };
  return fields;
}

const std::vector<JsonField<Fog>>& fogFields()
{
  static const std::vector<JsonField<Fog>> fields{
    row<&Fog::color, rules::unit>("color"),
    row<&Fog::density, rules::notNegative>("density"),
    row<&Fog::start, rules::notNegative>("start"),
  };
  return fields;
}

const std::vector<JsonField<Shutter>>& shutterFields()
{
  static const std::vector<JsonField<Shutter>> fields{
    row<&Shutter::open, rules::shutter>("open"),
    row<&Shutter::close, rules::shutter>("close"),
    row<&Shutter::exposures, rules::exposures>("exposures"),
  };
  return fields;
}

const std::vector<JsonField<RollingShutter>>& rollingShutterFields()
{
  static const std::vector<JsonField<RollingShutter>> fields{
    row<&RollingShutter::duration, rules::rollingShutter>("duration"),
    wordRow<&RollingShutter::direction, rollingDirections>("direction"),
  };
  return fields;
}

const std::vector<JsonField<Lens>>& lensFields()
{
  static const std::vector<JsonField<Lens>> fields{
    row<&Lens::aperture, rules::notNegative>("aperture"),
    row<&Lens::focus, rules::length>("focus"),
    row<&Lens::exposures, rules::exposures>("exposures"),
  };
  return fields;
}

JsonField<SceneDescription> backgroundRow() { return row<&SceneDescription::background, rules::unit>("background"); }
JsonField<SceneDescription> environmentRow()
{
  return structRow<&SceneDescription::environment, environmentFields>("environment");
}
JsonField<SceneDescription> fogRow() { return structRow<&SceneDescription::fog, fogFields>("fog"); }

} // namespace dgtk::scenefile
