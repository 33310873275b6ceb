#include <algorithm>
#include <cmath>

#include "make_human/bone_form.h"

// A form is written once in millimetres of its own axes; bones.csv puts it into the body: all vertebrae of a
// kind, all phalanges and teeth of a kind are one form in several sizes.
namespace vasa::human {
namespace {

constexpr float kStationStep = 2.5e-3f;                         // [m] between the stations of a tube, at most
constexpr float kGrooveStep = 1.5e-3f, kGrooveSwing = 1.1e-3f;  // of a suture's zigzag

/// Where a form's axes lie in the body, and how long its units are.
struct Placing {
  vec3 origin{0};
  mat3 axes{1};
  vec3 size{1e-3f};  // [m] of a unit along each axis

  vec3 place(vec3 p) const { return origin + axes * (size * p); }
  vec3 direction(vec3 d) const { return glm::normalize(axes * d); }
};

struct Rough {
  vec3 centre{0}, up{0};
  float width = 0, height = 0;
};

template <class Value>
Value catmullRom(Value a, Value b, Value c, Value d, float t) {
  return 0.5f * (2.0f * b + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * t * t +
                 (3.0f * b - a - 3.0f * c + d) * t * t * t);
}

Rough between(const std::vector<Rough>& all, std::size_t i, float t) {
  const Rough &b = all[i], &c = all[i + 1];
  const Rough &a = all[i > 0 ? i - 1 : i], &d = all[std::min(i + 2, all.size() - 1)];
  const auto size = [&](float p, float q, float r, float s) {
    return std::clamp(catmullRom(p, q, r, s, t), std::min(q, r), std::max(q, r));
  };
  return {catmullRom(a.centre, b.centre, c.centre, d.centre, t), glm::mix(b.up, c.up, t),
          size(a.width, b.width, c.width, d.width), size(a.height, b.height, c.height, d.height)};
}

std::vector<Rough> refined(const std::vector<Rough>& stations, float step) {
  if (stations.size() == 2) return stations;
  std::vector<Rough> fine;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const int steps =
        std::max(2, int(std::ceil(glm::distance(stations[i].centre, stations[i + 1].centre) / step)));
    for (int k = 0; k < steps; ++k) fine.push_back(between(stations, i, float(k) / float(steps)));
  }
  fine.push_back(stations.back());
  return fine;
}

/// Gives stations their directions and the piece its box.
void finish(BonePiece& piece, const std::vector<Rough>& rough) {
  for (std::size_t i = 0; i < rough.size(); ++i) {
    BonePiece::Station station{rough[i].centre, {1, 0, 0}, rough[i].up, rough[i].width, rough[i].height};
    if (rough.size() > 1) {
      const vec3 along =
          glm::normalize(rough[std::min(i + 1, rough.size() - 1)].centre - rough[i > 0 ? i - 1 : 0].centre);
      vec3 up = rough[i].up - glm::dot(rough[i].up, along) * along;
      if (glm::length(up) < 0.1f) up = anyPerpendicular(along);
      station.up = glm::normalize(up);
      station.across = glm::cross(station.up, along);
    }
    piece.stations.push_back(station);
    const float reach = std::max({station.width, station.height, i == 0 ? piece.capStart : 0.0f,
                                  i + 1 == rough.size() ? piece.capEnd : 0.0f});
    piece.bounds.add(station.centre - reach);
    piece.bounds.add(station.centre + reach);
  }
}

/// A line along the surface of what is there so far, swinging from side to side as a suture does.
std::vector<Rough> ontoSurface(const BoneForm& form, std::vector<Rough> line, float swing) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const vec3 along =
        glm::normalize(line[std::min(i + 1, line.size() - 1)].centre - line[i > 0 ? i - 1 : 0].centre);
    vec3 p = line[i].centre;
    for (int step = 0; step < 6; ++step) {
      const vec3 slope = form.gradient(p);
      const float square = glm::dot(slope, slope);
      if (square > 1e-3f) p -= form.distance(p) / square * slope;
      if (step == 2) {  // a slow and a quick wave; ends stay
        const float k = float(i), wave = std::sin(1.9f * k) + 0.6f * std::sin(0.83f * k + 1);
        p += swing * wave * glm::normalize(glm::cross(along, slope));
      }
    }
    line[i].centre = p;
  }
  return line;
}

class FormReader {
 public:
  FormReader(Table& bones, Table& forms, const Rig& rig, FormColumns columns)
      : bones_(bones), forms_(forms), rig_(rig), columns_(columns) {}

  void read(std::size_t row, std::vector<BoneForm>& to) {
    BoneForm form;
    form.name = bones_.text(row, columns_.name);
    form.tissue = bones_.text(row, columns_.tissue);
    form.paired = bones_.text(row, "side") == "LR";
    for (std::string_view name : split(bones_.text(row, "joint"), ' ')) {
      if (name.empty()) continue;
      form.path.push_back(rig_.find(name));
      if (form.path.back() < 0) bones_.fault(row, "no joint " + quoted(name));
    }
    if (form.path.empty()) bones_.fault(row, "a joint moves it");
    const Placing placing = placingOf(row);
    for (std::string_view name : split(bones_.text(row, "form"), '+')) {
      const std::size_t before = form.pieces.size();
      for (std::size_t r = 0; r < forms_.rowCount(); ++r)
        if (forms_.text(r, "form") == name) addPieces(r, placing, form);
      if (form.pieces.size() == before) bones_.fault(row, "no form " + quoted(name));
    }
    if (bones_.state().ok() && forms_.state().ok()) to.push_back(std::move(form));
  }

 private:
  Placing placingOf(std::size_t row) {
    Placing placing;
    const std::string_view origin = bones_.text(row, "origin"), towards = bones_.text(row, "towards"),
                           front = bones_.text(row, "front"), size = bones_.text(row, "size");
    if (!origin.empty()) placing.origin = bones_.take(row, rig_.place(origin, Side::left));
    vec3 y{0, 1, 0}, z{0, 0, 1};
    float length = 0;
    if (!towards.empty()) {
      const vec3 way = bones_.take(row, rig_.place(towards, Side::left)) - placing.origin;
      length = glm::length(way);
      if (length > 0) y = way / length;
    }
    if (!front.empty()) z = bones_.take(row, parseVector(front));
    z -= glm::dot(z, y) * y;
    if (glm::length(z) < 0.05f) {
      bones_.fault(row, "its front points along it");
      return placing;
    }
    z = glm::normalize(z);
    placing.axes = mat3(glm::cross(y, z), y, z);
    vec3 scale{1};
    if (!size.empty()) scale = bones_.take(row, parseVector(size));
    placing.size = 1e-3f * scale;
    if (length > 0) placing.size.y = 0.01f * length * scale.y;
    return placing;
  }

  std::vector<vec3> pointsOf(std::size_t row, const Placing& placing, bool mirror) {
    std::vector<vec3> points;
    for (std::string_view text : split(forms_.text(row, "points"), ';')) {
      vec3 p = forms_.take(row, parseVector(text));
      if (mirror) p.x = -p.x;
      points.push_back(placing.place(p));
    }
    return points;
  }

  std::vector<vec3> radiiOf(std::size_t row, const Placing& placing) {
    std::vector<vec3> radii;  // width, height, depth
    const bool ball = forms_.text(row, "shape") == "ball";
    for (std::string_view text : split(forms_.text(row, "radii_mm"), ' ')) {
      if (text.empty()) continue;
      const std::vector<std::string_view> parts = split(text, '*');
      vec3 r{forms_.take(row, parseNumber(parts.front()))};
      r.y = forms_.take(row, parseNumber(parts[parts.size() > 1 ? 1 : 0]));
      r.z = parts.size() > 2 ? forms_.take(row, parseNumber(parts[2])) : r.x;
      const float s = placing.size.x, deep = placing.size.z;
      radii.push_back(ball ? vec3(s * r.x, s * r.y, deep * r.z) : vec3(s * r.x, deep * r.y, 0));
      if (!(r.x > 0 && r.y > 0 && r.z > 0)) forms_.fault(row, "sizes must be positive");
    }
    return radii;
  }

  std::vector<vec3> upsOf(std::size_t row, const Placing& placing, bool mirror) {
    const std::string_view cell = forms_.text(row, "up");
    if (cell.empty()) return {placing.direction({0, 0, 1})};
    std::vector<vec3> ups;
    for (std::string_view text : split(cell, ';')) {
      vec3 up = forms_.take(row, parseVector(text));
      if (mirror) up.x = -up.x;
      ups.push_back(placing.direction(up));
    }
    return ups;
  }

  void addPieces(std::size_t row, const Placing& placing, BoneForm& form) {
    addPiece(row, placing, form, false);
    if (forms_.text(row, "side") == "both") addPiece(row, placing, form, true);
  }

  void addPiece(std::size_t row, const Placing& placing, BoneForm& form, bool mirror) {
    const std::string_view operation = forms_.text(row, "operation"), shape = forms_.text(row, "shape");
    if (operation != "add" && operation != "carve" && operation != "groove")
      forms_.fault(row, "an operation is add, carve or groove");
    if (shape != "tube" && shape != "ball") forms_.fault(row, "a shape is tube or ball");
    const std::vector<vec3> points = pointsOf(row, placing, mirror), radii = radiiOf(row, placing);
    const bool ball = shape == "ball";
    if (ball && (points.size() != 1 || radii.size() != 1))
      forms_.fault(row, "a ball has one point and three half axes");
    if (!ball && (points.size() < 2 || (radii.size() != 1 && radii.size() != points.size())))
      forms_.fault(row, "a tube has a radius for every point, or one for all");
    BonePiece piece;
    piece.carve = operation != "add";
    piece.blend = forms_.millimetres(row, "blend_mm");
    piece.cell = forms_.millimetres(row, "cell_mm");
    piece.square = forms_.numberOr(row, "square", 2);
    const std::vector<vec3> ups = upsOf(row, placing, mirror);
    if (ups.size() != 1 && ups.size() != points.size())
      forms_.fault(row, "a tube has an up for every point, or one for all");
    if (!forms_.state().ok()) return;
    if (ball) {
      piece.stations = {{points[0], placing.axes[0], placing.axes[1], radii[0].x, radii[0].y}};
      piece.capStart = piece.capEnd = radii[0].z;
      const float reach = std::max({radii[0].x, radii[0].y, radii[0].z});
      piece.bounds.add(points[0] - reach);
      piece.bounds.add(points[0] + reach);
    } else {
      std::vector<Rough> rough;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const vec3 r = radii[radii.size() == 1 ? 0 : i];
        rough.push_back({points[i], ups[ups.size() == 1 ? 0 : i], r.x, r.y});
      }
      const float cap = 1e-3f * forms_.numberOr(row, "cap_mm", 0);
      piece.capStart = cap > 0 ? cap : std::min(rough.front().width, rough.front().height);
      piece.capEnd = cap > 0 ? cap : std::min(rough.back().width, rough.back().height);
      rough = refined(rough, operation == "groove" ? kGrooveStep : kStationStep);
      if (operation == "groove") rough = ontoSurface(form, rough, kGrooveSwing);
      finish(piece, rough);
    }
    form.pieces.push_back(std::move(piece));
  }

  Table &bones_, &forms_;
  const Rig& rig_;
  FormColumns columns_;
};

}  // namespace

Result<std::vector<BoneForm>> readBoneForms(const std::filesystem::path& bones,
                                            const std::filesystem::path& forms, const Rig& rig,
                                            FormColumns columns) {
  Result<Table> boneTable = Table::read(bones);
  if (!boneTable.ok()) return boneTable.error();
  Result<Table> formTable = Table::read(forms);
  if (!formTable.ok()) return formTable.error();
  std::vector<BoneForm> result;
  FormReader reader(*boneTable, *formTable, rig, columns);
  for (std::size_t row = 0; row < boneTable->rowCount(); ++row) {
    reader.read(row, result);
    // A piece that is wrong is missing from its bone, too.
    if (!formTable->state().ok()) return formTable->state().error();
    if (!boneTable->state().ok()) return boneTable->state().error();
  }
  return result;
}

}  // namespace vasa::human
