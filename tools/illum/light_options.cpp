#include "light_options.h"

#include "illum/error.h"
#include "numbers.h"

namespace illum::cli {
namespace {

DirectionalLight directionalFrom(const std::string& text) {
  const Numbers numbers("--light", "x,y,z or x,y,z,r,g,b", text);
  if (numbers.count() != 3 && numbers.count() != 6) throw numbers.wrong();
  return {numbers.direction(0), numbers.colour(3)};
}

PointLight pointFrom(const std::string& text) {
  const Numbers numbers("--point", "x,y,z or x,y,z,r,g,b", text);
  if (numbers.count() != 3 && numbers.count() != 6) throw numbers.wrong();
  PointLight light;
  light.position = numbers.vector(0);
  light.intensity = numbers.colour(3);
  return light;
}

SpotLight spotFrom(const std::string& text) {
  const Numbers numbers("--spot", "x,y,z,tx,ty,tz,degrees or x,y,z,tx,ty,tz,degrees,r,g,b", text);
  if (numbers.count() != 7 && numbers.count() != 10) throw numbers.wrong();
  SpotLight light;
  light.position = numbers.vector(0);
  light.target = numbers.vector(3);
  light.coneDegrees = numbers[6];
  light.edgeDegrees = 0.2 * light.coneDegrees;
  light.intensity = numbers.colour(7);
  return light;
}

SkyLight skyFrom(const std::string& text) {
  const char* form = "overcast, clear,x,y,z or preetham,x,y,z[,turbidity]";
  const auto comma = text.find(',');
  const std::string model = text.substr(0, comma);
  SkyLight sky;
  if (model == "overcast" && comma == std::string::npos) return sky;
  const Numbers numbers("--sky", form, comma == std::string::npos ? "" : text.substr(comma + 1));
  const bool preetham = model == "preetham";
  if ((model != "clear" && !preetham) ||
      (numbers.count() != 3 && !(preetham && numbers.count() == 4)))
    throw wrongOption("--sky", form, text);
  sky.model = preetham ? SkyModel::Preetham : SkyModel::Clear;
  sky.sun = numbers.direction(0);
  if (numbers.count() == 4) sky.turbidity = numbers[3];
  return sky;
}

}  // namespace

void LightOptions::addTo(CLI::App& command) {
  const std::string group = "Lights (each may be repeated)";
  const auto add = [&](const char* name, std::vector<std::string>& texts, const char* help) {
    command.add_option(name, texts, help)->expected(1)->take_all()->group(group);
  };
  add("--light", lights, "x,y,z[,r,g,b] toward the light; repeat for several");
  add("--point", points, "x,y,z[,r,g,b] where a lamp stands, in units of the object");
  add("--spot", spots, "x,y,z,tx,ty,tz,degrees[,r,g,b]: where, its target, half the cone's angle");
  add("--env", environments, "equirectangular picture of the surroundings");
  add("--sky", skies, "overcast, clear,x,y,z or preetham,x,y,z[,turbidity]: x,y,z toward the sun");
  add("--lighting", setups, "set-up of lights of any kind, a file of JSON");
  command.add_option("--env-rotation", rotationDegrees, "turns --env about its y axis, in degrees")
      ->group(group);
  command.add_option("--env-exposure", exposureStops, "of --env, in stops")->group(group);
  command
      .add_option("--up", up, "x,y,z toward the top of --env, --sky and --camera (default: 0,1,0)")
      ->group(group);
}

bool LightOptions::empty() const {
  return lights.empty() && points.empty() && spots.empty() && environments.empty() &&
         skies.empty() && setups.empty();
}

Direction LightOptions::upward() const {
  if (up.empty()) return Direction::fromVector({0, 1, 0});
  const Numbers numbers("--up", "x,y,z", up);
  if (numbers.count() != 3) throw numbers.wrong();
  return numbers.direction(0);
}

Lighting LightOptions::lighting() const {
  const Direction top = upward();
  Lighting all;
  for (const auto& text : lights) all.lights.emplace_back(directionalFrom(text));
  for (const auto& text : points) all.lights.emplace_back(pointFrom(text));
  for (const auto& text : spots) all.lights.emplace_back(spotFrom(text));
  for (const auto& text : environments) {
    EnvironmentLight light;
    light.picture = text;
    light.rotationDegrees = rotationDegrees;
    light.exposureStops = exposureStops;
    light.up = top;
    all.lights.emplace_back(light);
  }
  for (const auto& text : skies) {
    SkyLight sky = skyFrom(text);
    sky.up = top;
    all.lights.emplace_back(sky);
  }
  for (const auto& text : setups) {
    for (const Light& light : readLighting(text).lights) all.lights.push_back(light);
  }
  return all;
}

}  // namespace illum::cli
