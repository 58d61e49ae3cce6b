// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The slots of a frame while it is lowered: who still needs each, and who wrote it.

#include <cstdint>
#include <optional>
#include <vector>

#include "vm/lower.h"

namespace mms::vm {

/// Where an operand that names a result is written down: in an instruction or in the operand pool.
struct Definition {
  bool pooled = false;
  std::size_t index = 0;
};

/// Hands out blocks of a frame and takes them back when nothing refers to them. A spectrum's run
/// of blocks is only ever reused for a spectrum, so slots overlap exactly or not at all.
class Slots {
 public:
  static constexpr int kPinned = 1 << 30;

  /// A slot that `refs` references point to.
  Operand allocate(SlotType type, int refs = 1) {
    std::vector<std::uint32_t>& free = free_[type == SlotType::Spectrum];
    std::uint32_t index = std::uint32_t(slots_.size());
    if (free.empty()) {
      slots_.resize(slots_.size() + block_count(type));
    } else {
      index = free.back();
      free.pop_back();
    }
    slots_[index] = {refs, 0, std::nullopt, type == SlotType::Spectrum};
    return Operand::make(Operand::Slot, index);
  }

  /// Adds `count` references, or takes them away. Operands that are no slots are left alone.
  void refer(Operand o, int count) {
    if (o.base() != Operand::Slot) return;
    Slot& slot = slots_[o.index()];
    slot.refs += count;
    if (slot.refs != 0) return;
    if (slot.reads == 1 && slot.definition && !slot.definition->pooled)
      read_once_.push_back(slot.definition->index);
    free_[slot.spectrum].push_back(o.index());
  }

  /// Instructions whose result one operand reads, and nothing else.
  const std::vector<std::size_t>& read_once() const { return read_once_; }

  /// Says what wrote `o`; to be called after the operands of that are read.
  /// None: several places write parts of it.
  void define(Operand o, std::optional<Definition> d) {
    if (o.base() != Operand::Slot) return;
    slots_[o.index()].definition = d;
    slots_[o.index()].reads = 0;
  }
  void read(Operand o) {
    if (o.base() == Operand::Slot) ++slots_[o.index()].reads;
  }

  /// The one place that writes `o`, if nothing has read it and this is its last reference: then
  /// that place may as well write elsewhere.
  std::optional<Definition> sole_definition(Operand o) const {
    if (o.base() != Operand::Slot || o.splat()) return std::nullopt;
    const Slot& slot = slots_[o.index()];
    return slot.refs == 1 && slot.reads == 0 ? slot.definition : std::nullopt;
  }

  std::uint32_t blocks() const { return std::uint32_t(slots_.size()); }

 private:
  struct Slot {
    int refs = 0, reads = 0;
    std::optional<Definition> definition;
    bool spectrum = false;
  };
  std::vector<Slot> slots_;  // by first block
  std::vector<std::uint32_t> free_[2];
  std::vector<std::size_t> read_once_;
};

}  // namespace mms::vm
