#!/usr/bin/env bash
# Unpacks the sources of TBB, as this Debian release has them, into a folder. Installs nothing and needs no root.
#   fetch_tbb.sh FOLDER
set -euo pipefail
folder=$1
mkdir -p "$(dirname "$folder")"
work=$(mktemp -d "$folder.part.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"

# Lists of packages of our own, since a machine rarely has those of source packages.
mkdir -p lists/partial cache/archives/partial unpacked
. /etc/os-release
cat >debian.sources <<END
Types: deb-src
URIs: http://deb.debian.org/debian
Suites: $VERSION_CODENAME
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
END
apt=(apt-get -q -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work" -o Dir::State::Lists="$work/lists"
     -o Dir::Cache="$work/cache" -o APT::Sandbox::User=root -o Acquire::Retries=2)
"${apt[@]}" update
"${apt[@]}" source --download-only onetbb
tar -xf onetbb_*.orig.tar.* -C unpacked --strip-components=1
mv -T unpacked "$folder"
