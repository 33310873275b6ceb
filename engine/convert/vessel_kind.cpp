#include <algorithm>
#include <array>

#include "convert/name_text.h"
#include "convert/source.h"

// The one place that says what names, numbers and colours mean for a vessel's kind.
namespace vasa {
namespace {

VesselKind kindOfShortForm(const NameText& name) {
  const std::string_view form = shortForm(name);
  if (form == "a" || form == "aa") return VesselKind::artery;
  return form == "v" || form == "vv" ? VesselKind::vein : VesselKind::other;
}

// Of a vein's names; those that need no other word to be one's.
constexpr std::string_view kPortal = "portal, portae, porta, porte";
constexpr std::string_view kPortalVein =
    "*pfortader*, 門脈, 門静脈, 门静脉, 門靜脈, 문맥, воротная, воротной, Воротная";

// With what follows the side in initials: LICA, RMCA, LSVC.
NameText withInitials(std::string_view raw) {
  NameText name(raw);
  const std::string words = name.words;
  for (std::size_t at = 1, end; (end = words.find(' ', at)) != words.npos; at = end + 1)
    if (end - at == 4 && (words[at] == 'l' || words[at] == 'r')) name.words += words.substr(at + 1, 4);
  return name;
}

// A text that says both ("artery beside a vein", "arteriovenous") says neither, and is left to the next
// source.
VesselKind kindInWords(const NameText& name) {
  // Arches and arcades of hand, foot and bowel are arteries where nothing says that they are venous.
  constexpr std::string_view kArtery =
      "*arter*, *artar*, *schlagader*, *slagader*, *aorta*, *aorte*, *aortic*, *carotid*, *carotis*, "
      "*coeliac trunk*, *celiac trunk*, *truncus coeliacus*, *tr coeliacus*, *tronco celiaco*, "
      "*tronc coeliaque*, *tronc celiaque*, *pulmonary trunk*, *truncus pulmonalis*, *tr pulm*, "
      "*tronco pulmonar*, *tronc pulmonaire*, *tronco polmonare*, *brachiocephalic trunk*, "
      "*truncus brachioc*, *tr brachioc*, *tronc brachio*, *tronco braquio*, *tronco brachio*, "
      "*thyrocervical*, *thyreocervical*, *costocervical*, *palmar arch*, *plantar arch*, *carpal arch*, "
      "*intestinal arcade*, *ramus interventricularis*, *r interventricularis*, *ramus circumflexus*, "
      "*r circumflexus*, lad, rca, lcx, rcx, riva, pda, cca, ica, eca, mca, aca, pca, acom, pcom, a com, "
      "p com, a co a, p co a, acoa, pcoa, pica, aica, sma, ima, cia, eia, iia, cfa, sfa, lpa, rpa, mpa, sca, bca, bct, ao, 動脈, "
      "动脉, 動静脈, 动静脉, 動靜脈, 동맥, 동정맥, ртери, АРТЕРИ, аорт, Аорт, АОРТ, 腹腔干, 头臂干, "
      "ревный ствол, еголовной ствол, очный ствол";
  constexpr std::string_view kVein =
      "vein*, vena, venas, venae, *vene, *venen, veia*, ader, aders, *venous*, *venos*, *venule*, *azygos*, "
      "*azygous*, cava, *jugular*, *pampiniform*, *pterygoid plexus*, *dural sinus*, *coronary sinus*, "
      "*sagittal sinus*, *transverse sinus*, *sigmoid sinus*, *straight sinus*, *occipital sinus*, "
      "*cavernous sinus*, *petrosal sinus*, *confluence of sinuses*, *sinus durae*, *sinus coronarius*, "
      "*sinus transversus*, *sinus sigmoideus*, *sinus rectus*, *sinus cavernosus*, *sinus sagittal*, "
      "*sinus longitudinal*, *sinus droit*, *seno coronario*, *seno sagit*, *seno retto*, *seno recto*, "
      "*seno transverso*, *seno trasverso*, svc, ivc, smv, imv, ijv, cfv, sss, gsv, ssv, 静脈, 静脉, 靜脈, "
      "정맥, вена, Вена, вены, Вены, ВЕНА, ВЕНЫ, ВЕНОЗ, веноз";
  constexpr std::string_view kLymph = "*lymph*, *thoracic duct*, リンパ, 淋巴, 림프, лимф";
  const bool artery = saysAny(name, kArtery), vein = saysAny(name, kVein) || saysAny(name, kPortalVein);
  if (saysAny(name, kLymph)) return VesselKind::lymphatic;
  if (artery == vein) return artery ? VesselKind::other : kindOfShortForm(name);
  return artery ? VesselKind::artery : VesselKind::vein;
}

// What a vessel runs beside or leaves tells its kind where nothing else does: "V. comitans arteriae
// brachialis" is a vein, "Ramus arteriae femoralis" an artery.
VesselKind kindInText(std::string_view raw) {
  const NameText name = withInitials(raw);
  NameText own = name;
  for (const std::string_view of : {" arteriae ", " venae "})
    if (const std::size_t at = own.words.find(of, 1);
        at != own.words.npos && !own.words.substr(0, at).ends_with(" et"))
      own.words.erase(at, of.size() - 1);
  if (own.words.size() < name.words.size())
    if (const VesselKind kind = kindInWords(own); kind != VesselKind::other) return kind;
  return kindInWords(name);
}

// The great vessels, whose names do not say it in every language.
struct Known {
  std::string_view ontology, number;
  VesselKind kind;
};
constexpr std::array kKnown{
    Known{"fma", "3734", VesselKind::artery},   // aorta
    Known{"fma", "3736", VesselKind::artery},   // ascending aorta
    Known{"fma", "3768", VesselKind::artery},   // arch of aorta
    Known{"fma", "3784", VesselKind::artery},   // descending aorta
    Known{"fma", "87217", VesselKind::artery},  // descending thoracic aorta
    Known{"fma", "3789", VesselKind::artery},   // abdominal aorta
    Known{"fma", "3932", VesselKind::artery},   // brachiocephalic artery
    Known{"fma", "8612", VesselKind::artery},   // pulmonary trunk
    Known{"fma", "50873", VesselKind::artery},  // left pulmonary artery
    Known{"fma", "50872", VesselKind::artery},  // right pulmonary artery
    Known{"fma", "4720", VesselKind::vein},     // superior vena cava
    Known{"fma", "10951", VesselKind::vein},    // inferior vena cava
    Known{"fma", "4706", VesselKind::vein},     // coronary sinus
    Known{"fma", "50735", VesselKind::portalVein},  Known{"uberon", "0000947", VesselKind::artery},  // aorta
    Known{"uberon", "0002333", VesselKind::artery},  // pulmonary trunk
    Known{"uberon", "0001585", VesselKind::vein},    // superior vena cava
    Known{"uberon", "0001072", VesselKind::vein},    // inferior vena cava
    Known{"uberon", "0005438", VesselKind::vein},    // coronary sinus
};

VesselKind kindByNumber(std::string_view raw) {
  const NameText name(raw);
  for (const Known& known : kKnown)
    if (saysAny(name, std::string(known.ontology) + ' ' + std::string(known.number))) return known.kind;
  return VesselKind::other;
}

bool namesPortal(std::string_view text) {
  const NameText name(text);
  return saysAny(name, kPortal) || saysAny(name, kPortalVein);
}

// Red and blue as every atlas has them, if it has; pink organs and grey plaster say nothing.
VesselKind kindOfColour(vec3 c) {
  constexpr float kClearly = 2;  // times as much as of either other colour
  if (c.r > 0.05f && c.r > kClearly * std::max(c.g, c.b)) return VesselKind::artery;
  if (c.b > 0.05f && c.b > kClearly * c.r && c.b > 1.25f * c.g) return VesselKind::vein;
  return VesselKind::other;
}

}  // namespace

VesselKind kindOf(const MeshMaterial& material) {
  const VesselKind kind = kindInText(material.name);
  if (kind == VesselKind::vein && namesPortal(material.name)) return VesselKind::portalVein;
  return kind == VesselKind::other && material.colour ? kindOfColour(*material.colour) : kind;
}

VesselKind kindOfTexts(const MeshElement& element, std::string_view fileName) {
  MeshElement bare{element.name, element.category, element.ontologyId, {}};
  for (const std::string& text : element.surroundings)
    if (std::ranges::find(element.materials, text, &MeshMaterial::name) == element.materials.end())
      bare.surroundings.push_back(text);
  return kindOf(bare, fileName);
}

VesselKind kindOf(const MeshElement& element, std::string_view fileName) {
  std::vector<std::string_view> numbered{element.ontologyId, element.name},
      texts{element.category, element.name, fileName};
  for (const std::string& name : element.surroundings) numbered.push_back(name), texts.push_back(name);
  VesselKind kind = kindInText(element.category);
  for (const std::string_view text : numbered)
    if (kind == VesselKind::other) kind = kindByNumber(text);
  for (const std::string_view text : texts)
    if (kind == VesselKind::other) kind = kindInText(text);
  if (kind == VesselKind::other && element.colour) kind = kindOfColour(*element.colour);
  if (kind != VesselKind::vein) return kind;
  const bool told = namesPortal(element.category) || namesPortal(element.name) ||
                    std::ranges::any_of(element.surroundings, namesPortal);
  return told ? VesselKind::portalVein : kind;
}

}  // namespace vasa
