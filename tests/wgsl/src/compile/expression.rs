//! Expressions.

use naga::{BinaryOperator, Expression, Handle, ImageQuery, RelationalFunction, Scalar, UnaryOperator};

use super::super::layout::{self, Kind};
use super::super::operators::{Binary, Ternary, Unary};
use super::super::program::{Operation, Slot};
use super::body::{Body, Compiled, spread};
use super::memory;
use super::place::{Base, Place};

impl Body<'_> {
    /// Compiles an expression.
    pub(super) fn expression(&mut self, handle: Handle<Expression>) -> Result<Compiled, String> {
        let words = match self.function.expressions[handle] {
            Expression::Literal(literal) => vec![self.constant(memory::literal(literal)?)],
            Expression::Constant(_) | Expression::ZeroValue(_) => {
                let words = memory::constant_words(self.module, &self.function.expressions, handle)?;
                words.into_iter().map(|word| self.constant(word)).collect()
            }
            Expression::Compose { ref components, .. } => {
                let mut words = Vec::new();
                for component in components {
                    words.append(&mut self.words(*component)?);
                }
                words
            }
            Expression::Access { base, index } => return self.access(base, index),
            Expression::AccessIndex { base, index } => {
                let (before, own) = layout::part(self.module, self.pointee(base), index)?;
                match self.compiled(base)? {
                    Compiled::Place(place) => return Ok(Compiled::Place(place.plus(before))),
                    Compiled::Words(words) => words[before as usize..(before + own) as usize].to_vec(),
                    Compiled::Texture(_) => return Err("textures have no parts".into()),
                }
            }
            Expression::Splat { size, value } => vec![self.word(value)?; size as usize],
            Expression::Swizzle { size, vector, pattern } => {
                let words = self.words(vector)?;
                pattern[..size as usize].iter().map(|component| words[*component as usize]).collect()
            }
            Expression::FunctionArgument(index) => return Ok(self.arguments[index as usize].clone()),
            Expression::GlobalVariable(global) => return self.globals[global.index()].clone(),
            Expression::LocalVariable(local) => return Ok(Compiled::Place(Place::memory(self.local(local)))),
            Expression::Load { pointer } => {
                let place = self.place(pointer)?;
                self.load(place, layout::words(self.module, self.inner(handle))?)
            }
            Expression::ImageLoad { image, coordinate, array_index: None, sample: None, level } => {
                let texture = self.texture(image)?;
                let at = self.words(coordinate)?;
                let level = match level {
                    Some(level) => self.word(level)?,
                    None => self.constant(0),
                };
                let &[x, y] = &at[..] else { return Err("only textures in the plane are known".into()) };
                let to = self.memory.fresh(1);
                self.emit(Operation::LoadTexel { to, texture, x, y, level });
                // What a format of one component has in the others.
                let one = if self.kind(handle)? == Kind::Float { self.float(1.0) } else { self.constant(1) };
                let zero = self.constant(0);
                vec![to, zero, zero, one]
            }
            Expression::ImageQuery { image, query: ImageQuery::Size { .. } } => {
                let texture = self.texture(image)?;
                let to = self.memory.fresh(2);
                self.emit(Operation::TextureSize { to, texture });
                vec![to, to + 1]
            }
            Expression::ImageQuery { query: ImageQuery::NumLevels, .. } => vec![self.constant(1)],
            Expression::Unary { op, expr } => {
                let words = self.words(expr)?;
                let unary = match (op, self.kind(expr)?) {
                    (UnaryOperator::Negate, Kind::Float) => Unary::Negate,
                    (UnaryOperator::Negate, _) => Unary::NegateInteger,
                    (UnaryOperator::LogicalNot, _) => Unary::LogicalNot,
                    (UnaryOperator::BitwiseNot, _) => Unary::Not,
                };
                self.each(unary, &words)
            }
            Expression::Binary { op, left, right } => self.binary_operator(op, left, right)?,
            Expression::Select { condition, accept, reject } => {
                let [condition, accept, reject] =
                    [self.words(condition)?, self.words(accept)?, self.words(reject)?];
                let mut selected = Vec::new();
                for (at, (a, b)) in accept.into_iter().zip(reject).enumerate() {
                    selected.push(self.ternary(Ternary::Select, spread(&condition, at), a, b));
                }
                selected
            }
            Expression::Relational { fun, argument } => {
                let words = self.words(argument)?;
                let fold = match fun {
                    RelationalFunction::All => Binary::And,
                    RelationalFunction::Any => Binary::Or,
                    _ => return Err(format!("the function {fun:?} is not known")),
                };
                let (first, rest) = words.split_first().ok_or("a truth of no words")?;
                vec![rest.iter().fold(*first, |all, word| self.binary(fold, all, *word))]
            }
            Expression::Math { fun, arg, arg1, arg2, arg3 } => self.math(fun, arg, [arg1, arg2, arg3])?,
            Expression::As { expr, kind, convert } => {
                let words = self.words(expr)?;
                match convert {
                    None => words,
                    Some(width) => {
                        self.converted(&words, self.kind(expr)?, layout::kind(Scalar { kind, width })?)
                    }
                }
            }
            Expression::ArrayLength(pointer) => {
                let place = self.place(pointer)?;
                let (stride, _) = layout::elements(self.module, self.pointee(pointer))?;
                let Base::Buffer(buffer) = place.base else { return Err("only buffers have lengths".into()) };
                let to = self.memory.fresh(1);
                self.emit(Operation::ArrayLength { to, buffer, offset: place.offset, stride });
                vec![to]
            }
            ref other => return Err(format!("expressions of kind `{}` are not known", name(other))),
        };
        Ok(Compiled::Words(words))
    }

    /// An element at an index that only running finds, or not even that.
    fn access(&mut self, base: Handle<Expression>, index: Handle<Expression>) -> Result<Compiled, String> {
        let (stride, bound) = layout::elements(self.module, self.pointee(base))?;
        let index = self.word(index)?;
        let compiled = self.compiled(base)?;
        let constant = self.memory.word(index).filter(|index| *index < bound);
        match compiled {
            Compiled::Place(place) => Ok(Compiled::Place(if let Some(index) = constant {
                place.plus(index * stride)
            } else {
                let to = self.memory.fresh(1);
                self.emit(Operation::Index { to, base: place.address, index, stride, bound });
                Place { address: Some(to), ..place }
            })),
            Compiled::Words(words) => {
                if let Some(index) = constant {
                    let first = (index * stride) as usize;
                    return Ok(Compiled::Words(words[first..first + stride as usize].to_vec()));
                }
                let address = self.memory.fresh(1);
                self.emit(Operation::Index { to: address, base: None, index, stride, bound });
                Ok(Compiled::Words(self.element(&words, address, stride)))
            }
            Compiled::Texture(_) => Err("textures have no elements".into()),
        }
    }

    /// So many words of a value at an address.
    fn element(&mut self, words: &[Slot], address: Slot, count: u32) -> Vec<Slot> {
        if let Some(constants) =
            words.iter().map(|slot| self.memory.word(*slot)).collect::<Option<Vec<u32>>>()
        {
            let table = self.memory.table(constants);
            let mut element = Vec::new();
            for at in 0..count {
                let at = self.constant(at);
                let address = self.binary(Binary::AddInteger, address, at);
                let to = self.memory.fresh(1);
                self.emit(Operation::LoadTable { to, table, address });
                element.push(to);
            }
            return element;
        }
        let first = self.memory.fresh(words.len() as u32);
        for (to, from) in (first..).zip(words) {
            self.emit(Operation::Store { to, from: *from });
        }
        self.load(Place { address: Some(address), ..Place::memory(first) }, count)
    }

    /// Scalars of one kind from scalars of another.
    fn converted(&mut self, words: &[Slot], from: Kind, to: Kind) -> Vec<Slot> {
        use Kind::{Bool, Float, Signed, Unsigned};
        let unary = match (from, to) {
            (Signed, Float) => Unary::FloatFromSigned,
            (Unsigned | Bool, Float) => Unary::FloatFromUnsigned,
            (Float, Signed) => Unary::SignedFromFloat,
            (Float, Unsigned) => Unary::UnsignedFromFloat,
            (Float, Bool) => Unary::BoolFromFloat,
            (Signed | Unsigned, Bool) => Unary::BoolFromInteger,
            (Float, Float) | (Signed | Unsigned | Bool, Signed | Unsigned) | (Bool, Bool) => {
                return words.to_vec();
            }
        };
        self.each(unary, words)
    }

    fn binary_operator(
        &mut self,
        operator: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Result<Vec<Slot>, String> {
        use BinaryOperator as Op;
        let kind = self.kind(left)?;
        let (a, b) = (self.words(left)?, self.words(right)?);
        if operator == Op::Multiply
            && let Some(product) = self.matrix_product(self.inner(left), self.inner(right), &a, &b)
        {
            return Ok(product);
        }
        let is_float = kind == Kind::Float;
        let is_signed = kind == Kind::Signed;
        // For floats, signed numbers, and unsigned ones.
        let of = |float, signed, unsigned| {
            if is_float {
                float
            } else if is_signed {
                signed
            } else {
                unsigned
            }
        };
        let (less, less_equal) = (
            of(Binary::Less, Binary::LessSigned, Binary::LessUnsigned),
            of(Binary::LessEqual, Binary::LessEqualSigned, Binary::LessEqualUnsigned),
        );
        let binary = match operator {
            Op::Greater => return Ok(self.pairs(less, &b, &a)),
            Op::GreaterEqual => return Ok(self.pairs(less_equal, &b, &a)),
            Op::Less => less,
            Op::LessEqual => less_equal,
            Op::Add => of(Binary::Add, Binary::AddInteger, Binary::AddInteger),
            Op::Subtract => of(Binary::Subtract, Binary::SubtractInteger, Binary::SubtractInteger),
            Op::Multiply => of(Binary::Multiply, Binary::MultiplyInteger, Binary::MultiplyInteger),
            Op::Divide => of(Binary::Divide, Binary::DivideSigned, Binary::DivideUnsigned),
            Op::Modulo => of(Binary::Remainder, Binary::RemainderSigned, Binary::RemainderUnsigned),
            Op::Equal => of(Binary::Equal, Binary::EqualInteger, Binary::EqualInteger),
            Op::NotEqual => of(Binary::NotEqual, Binary::NotEqualInteger, Binary::NotEqualInteger),
            Op::And | Op::LogicalAnd => Binary::And,
            Op::InclusiveOr | Op::LogicalOr => Binary::Or,
            Op::ExclusiveOr => Binary::Xor,
            Op::ShiftLeft => Binary::ShiftLeft,
            Op::ShiftRight if is_signed => Binary::ShiftRightSigned,
            Op::ShiftRight => Binary::ShiftRightUnsigned,
        };
        Ok(self.pairs(binary, &a, &b))
    }
}

/// The name of an expression's kind.
fn name(expression: &Expression) -> String {
    format!("{expression:?}").chars().take_while(|letter| letter.is_alphanumeric()).collect()
}
