#include "vis/renderer.h"

#include "sim/base/error.h"
#include "vis/arrows.h"
#include "vis/chart_layer.h"
#include "vis/colour_map.h"
#include "vis/fit.h"
#include "vis/force_chains.h"
#include "vis/gl/external_window.h"
#include "vis/gl/vtk_messages.h"
#include "vis/grain_colours.h"
#include "vis/grain_layer.h"
#include "vis/history.h"
#include "vis/overlay.h"
#include "vis/periodic_images.h"
#include "vis/pick.h"
#include "vis/read_back.h"
#include "vis/slice_layer.h"
#include "vis/solid_layer.h"
#include "vis/superellipsoid.h"
#include "vis/text_style.h"
#include "vis/ticks.h"
#include "vis/unhidden.h"
#include "vis/visible_grains.h"
#include "vis/wall_layer.h"

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace sandglass::vis {

namespace {

vtkSmartPointer<ExternalWindow> makeWindow(GlBackend wanted) {
  std::string reasons;
  const auto attempt = [&](auto make, const char* name) {
    std::string reason;
    auto context = make(reason);
    if (!context) reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", name, reason);
    return context;
  };
  std::unique_ptr<GlContext> context;
  if (wanted != GlBackend::egl) context = attempt(makeOsmesaContext, "OSMesa");
  if (!context && wanted != GlBackend::osmesa) context = attempt(makeEglContext, "EGL");
  if (!context) throw Error(fmt::format("no picture can be drawn on this machine, for {}.", reasons));
  auto window = vtkSmartPointer<ExternalWindow>::New();
  window->setContext(std::move(context));
  window->SetMultiSamples(0);
  window->SetAlphaBitPlanes(1);
  return window;
}

/// A key light from the upper left of the camera and a weaker one from the lower right: round grains without
/// black shadows, the same from every side.
void addLights(vtkRenderer* renderer) {
  struct Place {
    double x, y, z, intensity;
  };
  for (const auto& [x, y, z, intensity] : {Place{-0.45, 0.75, 1.2, 0.90}, Place{0.9, -0.3, 0.9, 0.38}}) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  }
}

void refuseBadSize(int width, int height) {
  constexpr int smallest = 16, largest = 16384; // what Mesa's rasteriser draws into
  if (std::min(width, height) < smallest || std::max(width, height) > largest)
    throw InputError(
        fmt::format("a picture of {} x {} pixels cannot be drawn; each side must be from {} to {}", width,
                    height, smallest, largest));
}

/// VTK's font cache, GLEW's table and more are shared by the whole process: one renderer works at a time.
std::mutex& vtkTurn() {
  static std::mutex turn;
  return turn;
}

} // namespace

struct Renderer::Impl {
  explicit Impl(GlBackend backend) : window(makeWindow(backend)) {
    addLights(scene);
    scene->AutomaticLightCreationOff();
    scene->AddActor(grains.actor());
    for (const auto& actors : {shapes.actors(), marks.actors(), walls.actors()})
      for (vtkActor* actor : actors)
        scene->AddActor(actor);
    scene->AddActor(slice.actor());
    overlayActor->GetScene()->AddItem(overlay);
    overlayActor->GetScene()->SetRenderer(scene);
    scene->AddActor(overlayActor);
    window->AddRenderer(scene);
    window->AddRenderer(charts.renderer());
    window->OpenGLInitContext();
    if (!window->fault().empty())
      throw Error(
          fmt::format("no picture can be drawn with {}: {}.", window->context().name(), window->fault()));
    glStrings = fmt::format("{} ({}, {})", window->context().name(), glText(GL_RENDERER), glText(GL_VERSION));
    window->context().release();
  }
  ~Impl() { window->MakeCurrent(); }

  static std::string glText(unsigned name) { return reinterpret_cast<const char*>(glGetString(name)); }

  /// Everything that is drawn lies between the clipping planes: the box and its copies, grains, `others`.
  void setCamera(const Eigen::AlignedBox3d& box, const std::vector<Vec3>& shifts,
                 const std::vector<Solid>& others) {
    vtkCamera* c = scene->GetActiveCamera();
    c->SetPosition(camera.position.data());
    c->SetFocalPoint(camera.target.data());
    c->SetViewUp(axesOf(camera).up.data());
    c->SetViewAngle(camera.viewAngle);
    c->SetParallelProjection(camera.orthographic);
    c->SetParallelScale(camera.orthographicHeight / 2);
    const Vec3 forward = axesOf(camera).forward;
    double near = std::numeric_limits<double>::infinity(), far = -near;
    const auto include = [&](const Vec3& p, double r) {
      const double depth = (p - camera.position).dot(forward);
      near = std::min(near, depth - r);
      far = std::max(far, depth + r);
    };
    for (int k = 0; k < 8; ++k)
      for (const Vec3& shift : shifts)
        include(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)) + shift, 0);
    for (std::size_t i = 0; i < visible.position.size(); ++i)
      include(visible.position[i], visible.radius[i]);
    for (const Solid& solid : others)
      include(solid.position, surroundingRadius(solid.shape));
    const double depth = std::max(far - near, 1e-9);
    far += 0.01 * depth;
    near -= 0.01 * depth;
    c->SetClippingRange(camera.orthographic ? near : std::max(near, 1e-3 * far), far);
  }

  /// Spheres in the frame's order, then others from front to back; at most view.maximumGrains.
  std::vector<std::size_t> grainsToDraw(const View& view, const PictureGeometry& picture) const {
    std::vector<std::size_t> seen = unhidden(visible, picture, detail.skipHidden && !view.meshes);
    const auto others =
        std::stable_partition(seen.begin(), seen.end(), [&](std::size_t k) { return visible.isSphere(k); });
    std::sort(seen.begin(), others);
    std::vector<std::size_t> result;
    for (const std::size_t k : evenSubset(seen.size(), view.maximumGrains))
      result.push_back(seen[k]);
    return result;
  }

  void showGrains(const std::vector<std::size_t>& subset, const std::vector<Rgb>& colours, bool meshes,
                  const PictureGeometry& picture) {
    std::vector<std::size_t> spheres;
    std::vector<Rgb> sphereColours;
    std::vector<Solid> others;
    for (std::size_t k = 0; k < subset.size(); ++k) {
      const std::size_t i = subset[k];
      const bool asSphere =
          visible.isSphere(i) ||
          (!meshes && pixelsAcross(visible.position[i], visible.radius[i], picture) < detail.smallestShape);
      if (asSphere) {
        spheres.push_back(i);
        sphereColours.push_back(colours[k]);
      } else {
        const auto shape = static_cast<std::size_t>(visible.shape[i]);
        others.push_back({visible.position[i], visible.orientation[i], visible.shapes[shape], colours[k],
                          visible.shape[i]});
      }
    }
    grains.show(visible, spheres, sphereColours);
    shapes.show(others, meshes);
    drawn = subset.size();
  }

  /// After a picture: the thread's context is free again, and what VTK complained about is an error.
  void release() {
    window->context().release();
    if (const std::string error = takeVtkError(); !error.empty())
      throw Error(fmt::format("the picture could not be drawn with {}: {}", window->context().name(), error));
  }

  Image render(const View& view, int finer) {
    const auto on = [&](const std::array<double, 3>& ground) {
      scene->SetBackground(ground[0], ground[1], ground[2]);
      window->Render();
      return readBack(window);
    };
    if (!view.transparentBackground) return reduced(on(view.background), finer);
    return reduced(withoutGround(on({0, 0, 0}), on({1, 1, 1})), finer);
  }

  vtkSmartPointer<ExternalWindow> window;
  vtkNew<vtkRenderer> scene;
  GrainLayer grains;
  SolidLayer shapes, marks; ///< grains that are no spheres; contacts, arrows, tracks
  WallLayer walls;
  SliceLayer slice;
  ChartLayer charts;
  vtkNew<Overlay> overlay;
  vtkNew<vtkContextActor> overlayActor;
  VisibleGrains visible;
  std::shared_ptr<const History> history;
  Detail detail;
  std::size_t drawn = 0;
  /// Of a pair, what was drawn first; the rest is the right half's.
  struct Half {
    VisibleGrains visible;
    Camera camera;
    int width = 0;
  };
  std::optional<Half> leftHalf;
  Camera camera;
  int width = 0, height = 0;
  std::string glStrings;
};

Renderer::Renderer(GlBackend backend) {
  const std::lock_guard lock(vtkTurn());
  keepVtkMessages();
  impl_ = std::make_unique<Impl>(backend);
}

Renderer::~Renderer() {
  const std::lock_guard lock(vtkTurn());
  impl_.reset();
}

Image Renderer::draw(const Frame& frame, const View& view) {
  refuseBadSize(view.width, view.height);
  Impl& d = *impl_;
  d.leftHalf.reset();
  d.width = view.width;
  d.height = view.height;
  d.visible = visibleGrains(frame, view, d.history.get());
  const Eigen::AlignedBox3d box = domainBox(frame);

  OverlayContent& over = d.overlay->content;
  // FXAA smooths edges by their contrast with the ground, which a transparent picture does not have: such a
  // picture is drawn twice as large instead.
  const int finer = std::max(view.supersampling, view.transparentBackground ? 2 : 1);
  refuseBadSize(finer * view.width, finer * view.height);
  over.supersampling = finer;
  over.width = finer * view.width;
  over.height = finer * view.height;
  over.background = view.background;
  over.backed = !view.transparentBackground;
  const auto sceneTitle = frame.provenance.find("title");
  over.title = view.title.empty() && sceneTitle != frame.provenance.end() ? sceneTitle->second : view.title;
  over.time = view.timeStamp ? timeText(frame.time) : "";
  GrainExtent extent;
  if (!view.camera.preset.empty()) extent.add(frame);
  d.camera = fitCamera(frame, view, extent);
  over.axes = view.axes ? std::optional(axesOf(d.camera)) : std::nullopt;
  over.metresPerPixel = view.scaleBar ? heightAtTarget(d.camera) / over.height : 0;

  const std::vector<std::size_t> subset = d.grainsToDraw(view, {d.camera, over.width, over.height});
  const GrainColours colours = grainColours(frame, view, d.visible, subset, d.history.get());
  over.legends.clear();
  if (view.legend && view.grains && colours.legend) over.legends.push_back(*colours.legend);
  std::vector<Solid> marks;
  const auto chains = addForceChains(marks, frame, view);
  if (view.legend && chains) over.legends.push_back(*chains);
  addArrows(marks, frame, view, d.history.get());
  addTracks(marks, frame, view, d.history.get());
  const auto sliced = d.slice.show(frame, view, d.camera, marks);
  if (view.legend && sliced) over.legends.push_back(*sliced);

  const std::lock_guard lock(vtkTurn());
  d.window->MakeCurrent();
  d.window->SetSize(over.width, over.height);
  d.scene->SetUseFXAA(finer == 1 && view.maximumGrains == 0); // a moving picture needs speed
  d.showGrains(subset, colours.ofGrain, view.meshes, {d.camera, over.width, over.height});
  d.walls.show(frame, view, d.camera, box, static_cast<float>(finer));
  constexpr double thinnest = 0.6; // [pixel]
  thicken(marks, thinnest * heightAtTarget(d.camera) / over.height);
  d.marks.show(marks, false);
  d.setCamera(box, imageShifts(frame.domain, view), marks);
  d.overlay->Modified();
  d.scene->DrawOn();
  d.charts.renderer()->DrawOff();
  Image image = d.render(view, finer);
  d.release();
  return image;
}

Image Renderer::drawPair(const Frame& left, const Frame& right, const View& leftView, const View& rightView,
                         std::shared_ptr<const History> leftHistory,
                         std::shared_ptr<const History> rightHistory) {
  View view = leftView;
  view.width = leftView.width / 2;
  setHistory(std::move(leftHistory));
  const Image first = draw(left, view);
  Impl::Half half{std::move(impl_->visible), impl_->camera, view.width};
  View other = rightView;
  other.width = leftView.width - view.width;
  other.height = leftView.height;
  other.camera = half.camera;
  setHistory(std::move(rightHistory));
  const Image second = draw(right, other);
  impl_->leftHalf = std::move(half);
  return beside(first, second);
}

void Renderer::setHistory(std::shared_ptr<const History> history) {
  impl_->history = std::move(history);
}

void Renderer::setDetail(const Detail& detail) {
  impl_->detail = detail;
}

std::size_t Renderer::drawnGrains() const {
  return impl_->drawn;
}

ChartPlace Renderer::chartPlace() const {
  return impl_->charts.place();
}

Image Renderer::draw(const analysis::Curve& curve, int width, int height, const ChartLook& look) {
  refuseBadSize(width, height);
  Impl& d = *impl_;
  const std::lock_guard lock(vtkTurn());
  d.window->MakeCurrent();
  d.window->SetSize(width, height);
  d.charts.show(curve, width, height, look);
  d.scene->DrawOff();
  d.charts.renderer()->DrawOn();
  d.window->Render();
  Image image = readBack(d.window);
  d.release();
  return image;
}

PickResult Renderer::pick(int x, int y) const {
  const Impl& d = *impl_;
  if (d.leftHalf) {
    const auto& left = *d.leftHalf;
    if (x >= 0 && y >= 0 && x < left.width && y < d.height)
      return pickAlong(rayThrough(left.camera, x, y, left.width, d.height), left.visible);
    x -= left.width;
  }
  if (x < 0 || y < 0 || x >= d.width || y >= d.height) return {};
  PickResult result = pickAlong(rayThrough(d.camera, x, y, d.width, d.height), d.visible);
  result.half = d.leftHalf ? 1 : 0;
  return result;
}

std::vector<std::int64_t> Renderer::grainsIn(int x0, int y0, int x1, int y1) const {
  const Impl& d = *impl_;
  if (!d.leftHalf) return grainsInRectangle(d.visible, {d.camera, d.width, d.height}, x0, y0, x1, y1);
  const auto& left = *d.leftHalf;
  if (x0 < left.width)
    return grainsInRectangle(left.visible, {left.camera, left.width, d.height}, x0, y0, x1, y1);
  return grainsInRectangle(d.visible, {d.camera, d.width, d.height}, x0 - left.width, y0, x1 - left.width,
                           y1);
}

Camera Renderer::resolvedCamera() const {
  return impl_->camera;
}

std::string Renderer::backendName() const {
  return impl_->glStrings;
}

} // namespace sandglass::vis
