// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkRenderer
 * @brief Renders layers of one camera at one frame into arrays.
 *
 * The arrays hold exactly what `dgtk render` writes: rows from top to bottom, one tuple a pixel. Threads may render at
 * the same time, each with a renderer of its own; Python's lock is free meanwhile. In a process that was forked after
 * its first picture was drawn by OpenGL, a renderer draws on where OpenGL can be had anew, and says so where it cannot.
 */
#ifndef dgtkRenderer_h
#define dgtkRenderer_h

#include "dgtkLayerOutputs.h"
#include "dgtkPipelineModule.h"

#include <memory> // private state
#include <string> // names

class dgtkScene;
class vtkDataArray;

class DGTKPIPELINE_EXPORT dgtkRenderer : public dgtkLayerOutputs
{
public:
  static dgtkRenderer* New();
  vtkTypeMacro(dgtkRenderer, dgtkLayerOutputs);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The scene to render; kept until another one is set.
   */
  void SetScene(dgtkScene* scene);

  ///@{
  /**
   * Camera by name (default: the first one) and frame (default: the first one).
   */
  void SetCamera(const std::string& name);
  void SetFrame(int frame);
  ///@}

  /**
   * Size of the image in pixels; 0, 0 (the default) is the camera's own, or 640 x 480.
   */
  void SetSize(int width, int height);
  /**
   * Colour is the mean of samples x samples points a pixel (1 to 16; default 1).
   */
  void SetSamples(int samples);
  /**
   * "auto" (default), "raster" or "ray".
   */
  void SetVisibility(const std::string& engine);
  /**
   * "auto" (default), "egl", "osmesa" or "glx". Read when OpenGL is first needed.
   */
  void SetGL(const std::string& backend);
  ///@{
  /**
   * Any of the options of GetOptions(), as on the command line: SetOption("points_step", "2"), SetOption("matte",
   * "tree,house"). Rendering fails, and says why, with one that is none.
   */
  void SetOption(const std::string& name, const std::string& value);
  void ClearOptions();
  ///@}
  /**
   * All options, one a line: name, what stands for the value (nothing for a switch), default and help, separated by
   * tabulators.
   */
  static std::string GetOptions();

  /**
   * The first output of a layer ("color", "depth", "objects", ...), null on failure; see RenderLayers().
   */
  vtkDataArray* Render(const std::string& layer);
  /**
   * Renders layers, their names separated by commas. False on failure, see GetErrorMessage(), which also names the
   * layers that can be had so.
   */
  bool RenderLayers(const std::string& layers);

protected:
  dgtkRenderer();
  ~dgtkRenderer() override;

private:
  dgtkRenderer(const dgtkRenderer&) = delete;
  void operator=(const dgtkRenderer&) = delete;

  struct Internal;
  std::unique_ptr<Internal> Self;
};

#endif
