//! Evaluates expressions.

use std::rc::Rc;

use naga::{
    AddressSpace, BinaryOperator, Expression, GlobalVariable, Handle, ImageQuery, RelationalFunction, Scalar,
    StorageAccess, TypeInner,
};

use super::binding::Texture;
use super::layout::{self, Kind};
use super::machine::{Frame, Machine, Mask, Operand, Place, constant_words, kind_name, lanes};
use super::operators::{LANES, Lanes, Term, Words, converted, select};

/// The constant 1.0.
const ONE: u32 = 0x3f80_0000;

impl<'m> Machine<'m> {
    /// Returns the type of an expression.
    pub(super) fn inner(&self, frame: &Frame<'m>, handle: Handle<Expression>) -> &'m TypeInner {
        frame.info[handle].ty.inner_with(&self.module().types)
    }

    /// Returns the type of an expression, or of its pointee.
    fn pointee(&self, frame: &Frame<'m>, handle: Handle<Expression>) -> &'m TypeInner {
        match *self.inner(frame, handle) {
            TypeInner::Pointer { base, .. } => &self.module().types[base].inner,
            ref other => other,
        }
    }

    /// Returns the scalar type of an expression.
    pub(super) fn kind(&self, frame: &Frame<'m>, handle: Handle<Expression>) -> Result<Kind, String> {
        match *self.inner(frame, handle) {
            TypeInner::Scalar(scalar)
            | TypeInner::Vector { scalar, .. }
            | TypeInner::Matrix { scalar, .. } => layout::kind(scalar),
            ref other => Err(format!("{other:?} has no single scalar type")),
        }
    }

    /// Returns the words of an expression.
    pub(super) fn words(&mut self, frame: &Frame<'m>, handle: Handle<Expression>) -> Result<Words, String> {
        match self.operand(frame, handle)? {
            Operand::Words(words) => Ok(words),
            other => Err(format!("expected a value, got a {}", kind_name(&other))),
        }
    }

    /// Returns the word of a scalar expression.
    pub(super) fn word(&mut self, frame: &Frame<'m>, handle: Handle<Expression>) -> Result<Lanes, String> {
        let words = self.words(frame, handle)?;
        words.first().copied().ok_or_else(|| "expected a scalar, got no words".into())
    }

    /// Returns the target of a pointer expression.
    pub(super) fn place(&mut self, frame: &Frame<'m>, handle: Handle<Expression>) -> Result<Place, String> {
        match self.operand(frame, handle)? {
            Operand::Place(place) => Ok(place),
            _ => Err("expected a pointer, got a value".into()),
        }
    }

    fn texture(&mut self, frame: &Frame<'m>, handle: Handle<Expression>) -> Result<usize, String> {
        match self.operand(frame, handle)? {
            Operand::Texture(index) => Ok(index),
            _ => Err("expected a texture, got a value".into()),
        }
    }

    /// Returns the result of an expression. Expressions that naga never emits are evaluated where
    /// they are used.
    pub(super) fn operand(
        &mut self,
        frame: &Frame<'m>,
        handle: Handle<Expression>,
    ) -> Result<Operand, String> {
        match &frame.values[handle.index()] {
            Some(operand) => Ok(operand.clone()),
            None => self.expression(frame, handle),
        }
    }

    /// Evaluates an expression.
    pub(super) fn expression(
        &mut self,
        frame: &Frame<'m>,
        handle: Handle<Expression>,
    ) -> Result<Operand, String> {
        let (module, rounding) = (self.module(), self.shader.rounding);
        let words: Words = match frame.function.expressions[handle] {
            Expression::Literal(_) | Expression::ZeroValue(_) | Expression::Constant(_) => {
                let known = &mut self.constants[frame.handle.index()][handle.index()];
                if let Some(words) = known {
                    return Ok(Operand::Words(Rc::clone(words)));
                }
                let words = constant_words(module, &frame.function.expressions, handle)?;
                Rc::clone(known.insert(words.into_iter().map(|word| [word; LANES]).collect()))
            }
            Expression::Compose { ref components, .. } => {
                let mut words = vec![];
                for component in components {
                    words.extend_from_slice(&self.words(frame, *component)?);
                }
                words.into()
            }
            Expression::Access { base, index } => return self.access(frame, base, index),
            Expression::AccessIndex { base, index } => {
                let (before, own) = layout::part(module, self.pointee(frame, base), index)?;
                match self.operand(frame, base)? {
                    Operand::Place(place) => return Ok(Operand::Place(place.plus(before))),
                    Operand::Words(words) => words[before as usize..(before + own) as usize].into(),
                    Operand::Texture(_) => return Err("textures have no components".into()),
                }
            }
            Expression::Splat { size, value } => vec![self.word(frame, value)?; size as usize].into(),
            Expression::Swizzle { size, vector, pattern } => {
                let words = self.words(frame, vector)?;
                pattern[..size as usize].iter().map(|component| words[*component as usize]).collect()
            }
            Expression::FunctionArgument(index) => return Ok(frame.arguments[index as usize].clone()),
            Expression::GlobalVariable(global) => return self.global(global),
            Expression::LocalVariable(local) => {
                let base = frame.locals[local.index()];
                return Ok(Operand::Place(Place { buffer: None, base, index: None }));
            }
            Expression::Load { pointer } => {
                let place = self.place(frame, pointer)?;
                self.load(&place, layout::words(module, self.inner(frame, handle))?, frame.mask)?
            }
            Expression::ImageLoad { image, coordinate, array_index: None, sample: None, level } => {
                let texture = self.texture(frame, image)?;
                let at = self.words(frame, coordinate)?;
                let level = level.map(|level| self.word(frame, level)).transpose()?.unwrap_or([0; LANES]);
                let [x, y] = &*at else { return Err("only textures in the plane are known".into()) };
                // The values of the missing components of a one-component format.
                let one = if self.kind(frame, handle)? == Kind::Float { ONE } else { 1 };
                [self.texel(texture, [x, y, &level], frame.mask)?, [0; LANES], [0; LANES], [one; LANES]]
                    .into()
            }
            Expression::ImageQuery { image, query: ImageQuery::Size { .. } } => {
                let texture = self.texture(frame, image)?;
                let texture = self.shader.bindings.texture_at(texture)?;
                [[texture.width; LANES], [texture.height; LANES]].into()
            }
            Expression::ImageQuery { query: ImageQuery::NumLevels, .. } => [[1; LANES]].into(),
            Expression::Unary { op, expr } => {
                rounding.unary(op, self.kind(frame, expr)?, &self.words(frame, expr)?)
            }
            Expression::Binary { op, left, right } => self.binary(frame, op, left, right)?,
            Expression::Select { condition, accept, reject } => select(
                &self.words(frame, condition)?,
                &self.words(frame, accept)?,
                &self.words(frame, reject)?,
            ),
            Expression::Relational { fun, argument } => {
                let fold = match fun {
                    RelationalFunction::All => BinaryOperator::And,
                    RelationalFunction::Any => BinaryOperator::InclusiveOr,
                    _ => return Err(format!("unsupported function {fun:?}")),
                };
                let words = self.words(frame, argument)?;
                let fold = |all: Words, word: &Lanes| {
                    rounding.binary(fold, Kind::Bool, &all, std::slice::from_ref(word))
                };
                words[1..].iter().fold([words[0]].into(), fold)
            }
            Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let operands = [Some(arg), arg1, arg2, arg3].into_iter().flatten();
                let operands: Vec<Words> =
                    operands.map(|operand| self.words(frame, operand)).collect::<Result<_, String>>()?;
                rounding.math(fun, self.kind(frame, arg)?, &operands)?
            }
            Expression::As { expr, kind, convert } => {
                let words = self.words(frame, expr)?;
                match convert {
                    None => words,
                    Some(width) => {
                        converted(&words, self.kind(frame, expr)?, layout::kind(Scalar { kind, width })?)
                    }
                }
            }
            Expression::ArrayLength(pointer) => {
                let place = self.place(frame, pointer)?;
                let (stride, _) = layout::elements(module, self.pointee(frame, pointer))?;
                let Some(buffer) = place.buffer else { return Err("only buffers have lengths".into()) };
                let words = self.shader.bindings.buffer_words(buffer)?.len() as u32;
                [[words.saturating_sub(place.base) / stride.max(1); LANES]].into()
            }
            ref other => return Err(format!("unsupported expression `{}`", kind_name(other))),
        };
        Ok(Operand::Words(words))
    }

    fn global(&self, handle: Handle<GlobalVariable>) -> Result<Operand, String> {
        let variable = &self.module().global_variables[handle];
        let index = handle.index();
        let buffer = Place { buffer: Some(index), base: 0, index: None };
        Ok(match variable.space {
            AddressSpace::Handle
                if matches!(self.module().types[variable.ty].inner, TypeInner::Image { .. }) =>
            {
                Operand::Texture(index)
            }
            AddressSpace::Uniform => Operand::Place(buffer),
            AddressSpace::Storage { access } if !access.contains(StorageAccess::STORE) => {
                Operand::Place(buffer)
            }
            AddressSpace::Private => {
                Operand::Place(Place { buffer: None, base: self.privates[index], index: None })
            }
            space => {
                let name = variable.name.as_deref().unwrap_or_default();
                return Err(format!("`{name}` is in the unsupported address space {space:?}"));
            }
        })
    }

    /// Returns an element at an index.
    fn access(
        &mut self,
        frame: &Frame<'m>,
        base: Handle<Expression>,
        index: Handle<Expression>,
    ) -> Result<Operand, String> {
        let (stride, bound) = layout::elements(self.module(), self.pointee(frame, base))?;
        let index = self.word(frame, index)?;
        let mut active = lanes(frame.mask).map(|lane| index[lane]);
        if let Some(outside) = active.clone().find(|index| *index >= bound) {
            return Err(format!("index {} is outside {bound} elements", outside.cast_signed()));
        }
        let first = active.next().unwrap_or(0);
        let common = active.all(|index| index == first).then(|| first.saturating_mul(stride));
        let word = |lane: usize| index[lane].saturating_mul(stride);
        Ok(match (self.operand(frame, base)?, common) {
            (Operand::Place(place), Some(words)) => Operand::Place(place.plus(words)),
            (Operand::Place(place), None) => {
                let mut to = place.index.as_deref().copied().unwrap_or([0; LANES]);
                lanes(frame.mask).for_each(|lane| to[lane] = to[lane].saturating_add(word(lane)));
                Operand::Place(Place { index: Some(Rc::new(to)), ..place })
            }
            (Operand::Words(words), Some(first)) => {
                Operand::Words(words[first as usize..(first + stride) as usize].into())
            }
            (Operand::Words(words), None) => {
                let element = |at: usize| {
                    let mut to = [0; LANES];
                    lanes(frame.mask).for_each(|lane| to[lane] = words[word(lane) as usize + at][lane]);
                    to
                };
                Operand::Words((0..stride as usize).map(element).collect())
            }
            (Operand::Texture(_), _) => return Err("textures have no elements".into()),
        })
    }

    /// Returns component x of texels.
    fn texel(&self, index: usize, [x, y, level]: [&Lanes; 3], mask: Mask) -> Result<Lanes, String> {
        let bindings = &self.shader.bindings;
        let &Texture { width, height, ref words } = bindings.texture_at(index)?;
        let mut to = [0; LANES];
        for lane in lanes(mask) {
            let [x, y, level] = [x, y, level].map(|word| word[lane]);
            if x >= width || y >= height || level != 0 {
                let [x, y, level] = [x, y, level].map(u32::cast_signed);
                let name = bindings.name(index);
                return Err(format!(
                    "texel ({x}, {y}) of level {level} is outside the {width} × {height} of `{name}`"
                ));
            }
            to[lane] = words[(y * width + x) as usize];
        }
        Ok(to)
    }

    fn binary(
        &mut self,
        frame: &Frame<'m>,
        operator: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Result<Words, String> {
        let rounding = self.shader.rounding;
        let kind = self.kind(frame, left)?;
        if matches!(operator, BinaryOperator::Add | BinaryOperator::Subtract) && kind == Kind::Float {
            let [left, right] = [self.factors(frame, left)?, self.factors(frame, right)?];
            let minus = operator == BinaryOperator::Subtract;
            return Ok(rounding.sum(term(&left), minus, term(&right)));
        }
        let (a, b) = (self.words(frame, left)?, self.words(frame, right)?);
        if operator == BinaryOperator::Multiply {
            let types = [self.inner(frame, left), self.inner(frame, right)];
            if let Some(product) = rounding.matrix_product(types, &a, &b) {
                return Ok(product);
            }
        }
        Ok(rounding.binary(operator, kind, &a, &b))
    }

    /// Returns an operand of a sum: both factors of a product that is fused with it, or its words.
    fn factors(
        &mut self,
        frame: &Frame<'m>,
        handle: Handle<Expression>,
    ) -> Result<(Words, Option<Words>), String> {
        match frame.function.expressions[handle] {
            Expression::Binary { left, right, .. } if self.is_fused_product(frame, handle) => {
                Ok((self.words(frame, left)?, Some(self.words(frame, right)?)))
            }
            _ => Ok((self.words(frame, handle)?, None)),
        }
    }
}

fn term((words, factor): &(Words, Option<Words>)) -> Term<'_> {
    factor.as_ref().map_or(Term::Value(words), |factor| Term::Product(words, factor))
}
