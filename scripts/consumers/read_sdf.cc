// Reads SDF files with libsdformat and prints what it found: per file the gravity, per model its name, whether it is
// static, place, orientation (w x y z), mass and shape.
#include <cstdio>
#include <sdf/sdf.hh>

static void print(const sdf::Model &model) {
  const auto &link = *model.LinkByIndex(0);
  const auto pose = model.RawPose();
  const auto shape = link.CollisionCount() ? link.CollisionByIndex(0)->Geom()->Type() : sdf::GeometryType::EMPTY;
  std::printf("model\t%s\t%d\t%.17g %.17g %.17g\t%.17g %.17g %.17g %.17g\t%.17g\t%d\n", model.Name().c_str(),
              model.Static(), pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z(), pose.Rot().W(), pose.Rot().X(),
              pose.Rot().Y(), pose.Rot().Z(), link.Inertial().MassMatrix().Mass(), static_cast<int>(shape));
}

int main(int count, char **files) {
  int wrong = 0;
  for (int at = 1; at < count; ++at) {
    sdf::Root root;
    for (const auto &error : root.Load(files[at])) {
      std::fprintf(stderr, "%s: %s\n", files[at], error.Message().c_str());
      wrong = 1;
    }
    if (wrong || root.WorldCount() != 1) return 1;
    const auto &world = *root.WorldByIndex(0);
    std::printf("world\t%s\t%.17g %.17g %.17g\n", files[at], world.Gravity().X(), world.Gravity().Y(),
                world.Gravity().Z());
    for (uint64_t i = 0; i < world.ModelCount(); ++i) print(*world.ModelByIndex(i));
  }
  return 0;
}
