// SPDX-License-Identifier: BSD-3-Clause
// The layers that relate a view with another: correspondence, disparity, optical flow and scene flow.
#include "dgtkError.h"
#include "dgtkPairPass.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace dgtk
{

namespace
{
LayerSpec positionSpec()
{
  return { "correspondence", PixelType::Float64, 2, "pixels", "image of the other camera", "nan",
    "(x', y') of the pixel's surface point in the other image; pixel centres are at + 0.5", Meaning::Point };
}

LayerSpec disparitySpec()
{
  return { "disparity", PixelType::Float64, 1, "pixels", "image", "nan",
    "x_left - x_right of the pixel's surface point in the two images of a rectified pair", Meaning::Displacement };
}

LayerSpec movedDisparitySpec(bool forward)
{
  LayerSpec spec = disparitySpec();
  spec.name = forward ? "disparity_forward" : "disparity_backward";
  spec.description = std::string("x_left - x_right that the pixel's surface point has one frame ") +
                     (forward ? "later" : "earlier") + ", in the two images of the rectified pair then";
  return spec;
}

LayerSpec flowSpec(bool forward)
{
  return { forward ? "flow_forward" : "flow_backward", PixelType::Float64, 2, "pixels", "image", "nan",
    std::string("(x' - x, y' - y) of the pixel's surface point one frame ") + (forward ? "later" : "earlier"),
    Meaning::Displacement };
}

LayerSpec motionSpec()
{
  return { "sceneflow", PixelType::Float64, 3, "scene units", "camera", "nan",
    "motion of the pixel's surface point in the world until the next frame, in the axes of this frame's camera",
    Meaning::Displacement };
}

LayerSpec classSpec(const std::string& layer)
{
  return { layer + "_class", PixelType::UInt8, 1, "class", "image", "0",
    "0 no surface, 1 visible, 2 occluded by another object, 3 occluded by its own object, 4 outside the image, "
    "5 behind the camera",
    Meaning::Visibility };
}

/// A layer of targets; what differs is which targets a job has.
class PairLayer : public Layer
{
public:
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofHits(); }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    std::vector<LayerRecord> records{ { this->valueSpec(), format } };
    if (this->hasClasses())
    {
      records.push_back({ classSpec(this->valueSpec().name), "png" });
    }
    return records;
  }

  std::vector<LayerOutput> outputs(
    const WorkPlan& plan, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    const LayerOutput values = imageOutput(plan, stage, job, this->valueSpec(), planned.formats);
    std::vector<LayerOutput> all;
    for (const PairTarget& target : this->completeTargets(plan, stage, job))
    {
      all.push_back(values);
      all.back().name = target.folder;
      all.back().path = WorkPlan::stem(stage.description().cameras[job.camera].name, target.folder, job.frame);
      if (this->hasClasses())
      {
        all.push_back(all.back());
        LayerOutput& classes = all.back();
        classes.spec = classSpec(values.layer);
        classes.layer = classes.spec.name;
        classes.name += "_class";
        classes.formats = { "png" };
      }
    }
    return all;
  }

  std::string passKey() const override { return "pairs"; }

  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>& layers) const override
  {
    std::vector<PairTarget> targets;
    for (const PassLayer& layer : layers)
    {
      const std::vector<PairTarget> own =
        static_cast<const PairLayer&>(layer.layer).completeTargets(context.plan, context.queries.stage(), context.job);
      targets.insert(targets.end(), own.begin(), own.end());
    }
    return makePairPass(context, targets);
  }

protected:
  virtual LayerSpec valueSpec() const = 0;
  virtual bool hasClasses() const { return true; }
  /// The targets of a job: camera, frame, value and, where it is not the layer's name, folder.
  virtual std::vector<PairTarget> targets(const WorkPlan& plan, const Stage& stage, const Job& job) const = 0;

private:
  std::vector<PairTarget> completeTargets(const WorkPlan& plan, const Stage& stage, const Job& job) const
  {
    std::vector<PairTarget> all = this->targets(plan, stage, job);
    for (PairTarget& target : all)
    {
      target.spec = this->valueSpec();
      target.folder = target.folder.empty() ? target.spec.name : target.folder;
    }
    return all;
  }
};

bool isFrame(const Stage& stage, int frame)
{
  return frame >= stage.description().firstFrame() && frame <= stage.description().lastFrame();
}

const NamesOption pairsOption(
  "pairs", "A:B,...", "all", "camera pairs of the correspondence layer; A:B+1 one frame later");

/// The pairs that are asked for; none for all.
std::vector<std::string> pairTexts(const WorkPlan& plan)
{
  std::vector<std::string> texts = pairsOption.of(plan.request.options);
  return texts == std::vector<std::string>{ pairsOption.fallback } ? std::vector<std::string>() : texts;
}

bool hasFrames(const SceneDescription& scene) { return scene.lastFrame() > scene.firstFrame(); }

/// Another camera and how many frames later.
struct Pair
{
  std::size_t from = 0;
  std::size_t to = 0;
  int offset = 0;
  std::string text = {}; ///< as the request names it
};

/// "+1", "-2", "".
std::string stepText(int offset) { return offset == 0 ? "" : (offset > 0 ? "+" : "") + std::to_string(offset); }

/// "A:B", "A:B+1", "A:B-2". Names hold no colons, but maybe signs: a camera of the whole name comes first, also of the
/// number without needless zeros, which is how its folder is called. Returns what is no camera, or no pair; else "".
std::string parsePair(const std::vector<std::string>& names, Pair& pair)
{
  const auto find = [&](const std::string& name, std::size_t& camera)
  {
    camera = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    return camera < names.size();
  };
  const std::string first = pair.text.substr(0, pair.text.find(':'));
  if (first == pair.text || !find(first, pair.from))
  {
    return first.empty() ? pair.text : first;
  }
  const std::string other = pair.text.substr(first.size() + 1);
  if (find(other, pair.to))
  {
    return {};
  }
  const std::size_t sign = other.find_last_of("+-");
  const std::string step = sign == std::string::npos ? "" : other.substr(sign);
  if (step.size() < 2 || step.size() > 7 || step.find_first_not_of("0123456789", 1) != std::string::npos)
  {
    return sign == std::string::npos && !other.empty() ? other : pair.text;
  }
  const int offset = std::stoi(step);
  if (find(other.substr(0, sign) + stepText(offset), pair.to))
  {
    return {};
  }
  pair.offset = offset;
  return find(other.substr(0, sign), pair.to) ? std::string() : other.substr(0, sign);
}

/// The pairs of a request, without repetition, in its order; with `own`, those that begin at that camera: thousands,
/// for each of thousands of pictures, would take minutes.
std::vector<Pair> pairsOf(
  const WorkPlan& plan, const Stage& stage, const std::optional<std::size_t>& own = std::nullopt)
{
  std::vector<Pair> pairs;
  std::set<std::size_t> cameras; // each frame has all
  for (auto job = plan.jobs.begin(); job != plan.jobs.end() && job->frame == plan.jobs.front().frame; ++job)
  {
    cameras.insert(job->camera);
  }
  const std::vector<std::string> texts = pairTexts(plan);
  if (texts.empty())
  {
    for (const std::size_t from : own ? std::set<std::size_t>{ *own } : cameras)
    {
      for (const std::size_t to : cameras)
      {
        if (from != to)
        {
          pairs.push_back({ from, to, 0 });
        }
      }
    }
    return pairs;
  }
  const std::vector<std::string> names = stage.cameraNames();
  std::set<std::tuple<std::size_t, std::size_t, int>> known;
  const std::string start = own ? names[*own] + ':' : std::string();
  for (const std::string& text : texts)
  {
    if (text.compare(0, start.size(), start) != 0)
    {
      continue;
    }
    Pair pair;
    pair.text = text;
    if (const std::string unknown = parsePair(names, pair); !unknown.empty())
    {
      throw UsageError("pairs: expected FROM:TO with names of cameras and maybe +N or -N frames, found " +
                       quoted(text) + (unknown == text ? "" : ", where " + quoted(unknown) + " is no camera"));
    }
    if (pair.from == pair.to && pair.offset == 0)
    {
      throw UsageError("pairs: " + quoted(text) + " is a camera with itself at the same frame");
    }
    if (cameras.count(pair.from) == 0)
    {
      throw UsageError("pairs: camera " + quoted(names[pair.from]) + " is not among those of the run");
    }
    if (known.emplace(pair.from, pair.to, pair.offset).second)
    {
      pairs.push_back(pair);
    }
  }
  return pairs;
}

class CorrespondenceLayer final : public PairLayer
{
public:
  LayerInfo info() const override
  {
    return { "correspondence", { "npy" }, "where each pixel's surface point is in other images, and its visibility" };
  }
  void check(const WorkPlan& plan, const Stage& stage, const PlannedLayer&) const override
  {
    for (const Pair& pair : pairsOf(plan, stage))
    {
      if (!pair.text.empty() &&
          std::none_of(plan.jobs.begin(), plan.jobs.end(),
            [&](const Job& job) { return job.camera == pair.from && isFrame(stage, job.frame + pair.offset); }))
      {
        throw UsageError(
          "pair " + quoted(pair.text) + " leads from every frame of this run to one that the scene does not have");
      }
    }
  }
  std::string requirement() const override
  {
    return "another camera in the run, or a pair of cameras that ends within the frames of the scene";
  }
  std::vector<const OptionRow*> options() const override { return { &pairsOption }; }

protected:
  LayerSpec valueSpec() const override { return positionSpec(); }
  std::vector<PairTarget> targets(const WorkPlan& plan, const Stage& stage, const Job& job) const override
  {
    std::vector<PairTarget> all;
    for (const Pair& pair : pairsOf(plan, stage, job.camera))
    {
      const int frame = job.frame + pair.offset;
      if (pair.from != job.camera || !isFrame(stage, frame))
      {
        continue;
      }
      PairTarget target;
      target.camera = pair.to;
      target.frame = frame;
      target.folder = "correspondence_" + stage.description().cameras[pair.to].name + stepText(pair.offset);
      all.push_back(target);
    }
    return all;
  }
};

struct Partner
{
  std::size_t camera = 0;
  double baseline = 0; ///< its place on the x axis of the other
};

/// The nearest camera with which `camera` is a rectified pair at a frame; of several the first by name. One of the run,
/// where it has one.
std::optional<Partner> rectifiedPartner(const WorkPlan& plan, const Stage& stage, std::size_t camera, int frame)
{
  const auto view = [&](std::size_t c) { return stage.view(c, frame, plan.request.width, plan.request.height); };
  const View own = view(camera);
  std::map<std::string, std::size_t> cameras;
  for (const CameraDescription& one : stage.description().cameras)
  {
    cameras.emplace(one.name, cameras.size());
  }
  const auto nearestOf = [&](const std::set<std::string>& names)
  {
    std::optional<Partner> partner;
    for (const auto& [name, c] : cameras)
    {
      if (c == camera || (!names.empty() && names.count(name) == 0))
      {
        continue;
      }
      const View other = view(c);
      const double baseline = rectifiedBaseline(own, other);
      if (baseline != 0 && (!partner || std::abs(baseline) <
                                          std::abs(partner->baseline) * (1 - 1e-9) - 2 * baselineRounding(own, other)))
      {
        partner = Partner{ c, baseline };
      }
    }
    return partner;
  };
  const std::optional<Partner> ran = nearestOf({ plan.request.cameras.begin(), plan.request.cameras.end() });
  return ran ? ran : nearestOf({});
}

class DisparityLayer final : public PairLayer
{
public:
  LayerInfo info() const override
  {
    return { "disparity", { "pfm", "npy", "exr" },
      "x_left - x_right for cameras of rectified pairs, and visibility in the other image" };
  }
  std::string requirement() const override
  {
    return "two cameras side by side: the same K but cx, the same orientation, displaced along the x axis";
  }

protected:
  LayerSpec valueSpec() const override { return disparitySpec(); }
  std::vector<PairTarget> targets(const WorkPlan& plan, const Stage& stage, const Job& job) const override
  {
    const std::optional<Partner> partner = rectifiedPartner(plan, stage, job.camera, job.frame);
    if (!partner)
    {
      return {};
    }
    PairTarget target;
    target.camera = partner->camera;
    target.frame = job.frame;
    target.value = partner->baseline > 0 ? PairValue::FromLeft : PairValue::FromRight;
    return { target };
  }
};

/// Why the frame that a layer leads to is not one of the run's.
std::vector<std::string> notesOnStep(const WorkPlan& plan, const std::string& layer, int step, const std::string& other)
{
  const int taken = plan.request.frames ? plan.request.frames->step : 1;
  if (taken == 1)
  {
    return {};
  }
  return { "layer " + layer + " leads to the scene's frame one " + (step > 0 ? "later" : "earlier") +
           ", which this run of every " + std::to_string(taken) + " frames does not have" + other };
}

/// The pair's disparity of surface points at a neighbouring frame.
class MovedDisparityLayer final : public PairLayer
{
public:
  explicit MovedDisparityLayer(int step)
    : Step(step)
  {
  }
  LayerInfo info() const override
  {
    return { this->valueSpec().name, { "pfm", "npy", "exr" },
      std::string("disparity that each pixel's surface point has ") +
        (this->Step > 0 ? "at the next frame" : "at the frame before") + ", and visibility in the other image then",
      false, {}, &hasFrames };
  }
  std::vector<std::string> notes(const WorkPlan& plan, const Stage&) const override
  {
    return notesOnStep(plan, this->valueSpec().name, this->Step, "");
  }
  std::string requirement() const override
  {
    return std::string("a frame of the scene ") + (this->Step > 0 ? "after" : "before") +
           " the picture's own, and two cameras side by side at both";
  }

protected:
  LayerSpec valueSpec() const override { return movedDisparitySpec(this->Step > 0); }
  std::vector<PairTarget> targets(const WorkPlan& plan, const Stage& stage, const Job& job) const override
  {
    PairTarget target;
    target.frame = job.frame + this->Step;
    const std::optional<Partner> partner = rectifiedPartner(plan, stage, job.camera, job.frame);
    if (!partner || !isFrame(stage, target.frame))
    {
      return {};
    }
    const auto then = [&](std::size_t camera)
    { return stage.view(camera, target.frame, plan.request.width, plan.request.height); };
    if (!(rectifiedBaseline(then(job.camera), then(partner->camera)) * partner->baseline > 0))
    {
      return {};
    }
    target.camera = partner->camera;
    target.value = partner->baseline > 0 ? PairValue::FromLeft : PairValue::FromRight;
    target.isMoved = true;
    return { target };
  }

private:
  int Step;
};

/// The same camera at a neighbouring frame.
class MotionLayer : public PairLayer
{
public:
  MotionLayer(PairValue value, int step)
    : Value(value)
    , Step(step)
  {
  }
  std::vector<std::string> notes(const WorkPlan& plan, const Stage&) const override
  {
    const std::string taken = std::to_string(plan.request.frames ? plan.request.frames->step : 1);
    return notesOnStep(plan, this->valueSpec().name, this->Step,
      " (correspondence of the pair NAME:NAME+" + taken + " leads on to its next one)");
  }
  LayerInfo info() const override
  {
    if (this->Value == PairValue::Motion)
    {
      return { "sceneflow", { "npy", "exr" }, "3D motion of each pixel's surface point until the next frame", false, {},
        &hasFrames };
    }
    return { this->valueSpec().name, { "flo", "npy", "exr" },
      this->Step > 0 ? "optical flow to the next frame, and visibility there"
                     : "optical flow to the frame before, and visibility there",
      false, {}, &hasFrames };
  }

  std::string requirement() const override
  {
    return std::string("a frame of the scene ") + (this->Step > 0 ? "after" : "before") + " the picture's own";
  }

protected:
  LayerSpec valueSpec() const override
  {
    return this->Value == PairValue::Motion ? motionSpec() : flowSpec(this->Step > 0);
  }
  bool hasClasses() const override { return this->Value != PairValue::Motion; }
  std::vector<PairTarget> targets(const WorkPlan&, const Stage& stage, const Job& job) const override
  {
    PairTarget target;
    target.camera = job.camera;
    target.frame = job.frame + this->Step;
    target.value = this->Value;
    if (!isFrame(stage, target.frame))
    {
      return {};
    }
    return { target };
  }

private:
  PairValue Value;
  int Step;
};
} // namespace

LayerList pairLayers()
{
  return { std::make_shared<CorrespondenceLayer>(), std::make_shared<DisparityLayer>(),
    std::make_shared<MovedDisparityLayer>(1), std::make_shared<MovedDisparityLayer>(-1),
    std::make_shared<MotionLayer>(PairValue::Displacement, 1),
    std::make_shared<MotionLayer>(PairValue::Displacement, -1), std::make_shared<MotionLayer>(PairValue::Motion, 1) };
}

} // namespace dgtk
