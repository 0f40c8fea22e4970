# Makes an SPDX 2.3 document of the lines that image_sbom.sh writes, and of the arguments application, version, kind, sum and created.
def known: if . == "-" then null else . end;
def reference: gsub("\\+"; "plus") | gsub("[^A-Za-z0-9.-]"; "-");

def package:
  split("\t") as [$kind, $name, $version, $architecture, $sum, $license, $relation] |
  {
    SPDXID: "SPDXRef-\($kind)-\($name | reference)",
    name: $name,
    versionInfo: $version,
    downloadLocation: "NOASSERTION",
    filesAnalyzed: false,
    supplier: (if $kind == "deb" then "Organization: Debian" else "NOASSERTION" end),
    licenseConcluded: "NOASSERTION",
    licenseDeclared: ($license | known // "NOASSERTION"),
    copyrightText: "NOASSERTION",
    relation: $relation
  } + if $kind == "own" then {} else {externalRefs: [{
    referenceCategory: "PACKAGE-MANAGER",
    referenceType: "purl",
    referenceLocator: (if $kind == "deb" then "pkg:deb/debian/\($name | @uri)@\($version | @uri)?arch=\($architecture)"
                       else "pkg:npm/\($name | split("/") | map(@uri) | join("/"))@\($version | @uri)" end)
  }]} end + (($sum | known) as $known | if $known then {checksums: [{algorithm: "SHA256", checksumValue: $known}]} else {} end);

[inputs | package] | unique_by(.SPDXID) as $packages |
"SPDXRef-\($kind)" as $described |
{
  spdxVersion: "SPDX-2.3",
  dataLicense: "CC0-1.0",
  SPDXID: "SPDXRef-DOCUMENT",
  name: "\($application) \($version), \($kind) for an industrial PC",
  documentNamespace: "https://spdx.org/spdxdocs/flexrf-\($application | @uri)-\($kind)-\($sum)",
  creationInfo: {created: $created, creators: ["Tool: flexrf"]},
  packages: ([{
    SPDXID: $described,
    name: $application,
    versionInfo: $version,
    downloadLocation: "NOASSERTION",
    filesAnalyzed: false,
    supplier: "NOASSERTION",
    licenseConcluded: "NOASSERTION",
    licenseDeclared: "NOASSERTION",
    copyrightText: "NOASSERTION",
    primaryPackagePurpose: "OPERATING_SYSTEM",
    comment: "The checksum is that of the root (squashfs), which the PC compares at each start.",
    checksums: [{algorithm: "SHA256", checksumValue: $sum}]
  }] + ($packages | map(del(.relation)))),
  relationships: ([{spdxElementId: "SPDXRef-DOCUMENT", relationshipType: "DESCRIBES", relatedSpdxElement: $described}] +
    ($packages | map({spdxElementId: $described, relationshipType: .relation, relatedSpdxElement: .SPDXID})))
}
