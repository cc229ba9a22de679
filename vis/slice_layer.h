#pragma once
// A plane through a coarse-grained field, coloured by one of its arrays, cut by the view's clips.

#include "vis/clip.h"
#include "vis/legend.h"
#include "vis/solids.h"
#include "vis/view.h"

#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

namespace sandglass::vis {

class SliceLayer {
public:
  SliceLayer();
  vtkActor* actor() const { return actor_; }

  /// Shows what the view asks for, and adds its streamlines to `lines`. Throws InputError when the frame has
  /// no such field or array.
  std::optional<Legend> show(const Frame& frame, const View& view, const Camera& camera,
                             std::vector<Solid>& lines);

private:
  vtkNew<vtkActor> actor_;
  FragmentClip clip_{actor_};
};

/// The field as VTK image data with every array.
vtkSmartPointer<vtkImageData> imageOf(const FrameField& field);

} // namespace sandglass::vis
